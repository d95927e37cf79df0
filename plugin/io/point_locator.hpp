#pragma once

#include "mfem.hpp"

#include <array>
#include <vector>

namespace synovia
{

/// Where a point lies in the undeformed mesh, on the rank that has it.
struct LocatedPoint
{
   /// Element of this rank, or -1 where another rank has the point.
   int element = -1;
   /// May lie outside the reference element by a little, see LocatePoints().
   mfem::IntegrationPoint ip;
};

/// Finds points in those elements of a mesh that have one of the attributes.
///
/// Touching bodies share no elements, so that the attributes decide in which of
/// them a point of the interface lies. Points that are outside by no more than
/// 5 % of an element's size count as its own, and fields are continued to them
/// as polynomials: straight-sided elements cut the corners of curved bodies.
/// Each point is found by exactly one rank.
///
/// Collective. @a attributes may be empty, for all elements. Throws Error with
/// the coordinates of the first point that is nowhere.
std::vector<LocatedPoint>
LocatePoints(const mfem::ParMesh &mesh, const mfem::Array<int> &attributes,
             const std::vector<std::array<mfem::real_t, 3>> &points);

} // namespace synovia
