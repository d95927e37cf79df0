#pragma once

#include "synovia/contact/surface_pairing.hpp"

#include <vector>

namespace synovia
{

/// Points of a SurfacePairing that follow each other; at least one. Borrows
/// them.
class PointRange
{
public:
   PointRange(const PairedPoint *first_, const PairedPoint *last_)
      : first(first_), last(last_)
   {
   }

   const PairedPoint *begin() const { return first; }
   const PairedPoint *end() const { return last; }
   const PairedPoint &First() const { return *first; }

private:
   const PairedPoint *first;
   const PairedPoint *last;
};

/// The points of each face of the destination. Borrows @a points, which are in
/// the order of a pairing's: face by face, and source face by source face.
std::vector<PointRange> GroupByFace(const std::vector<PairedPoint> &points);

/// Those of each source face that they hit.
std::vector<PointRange> GroupBySource(const PointRange &face_points);

/// Those of each pair of faces.
std::vector<PointRange> GroupByFacePair(const std::vector<PairedPoint> &points);

} // namespace synovia
