#include "synovia/contact/finite_gap.hpp"
#include "synovia/contact/bearing_shares.hpp"
#include "synovia/contact/paired_point_shapes.hpp"
#include "synovia/contact/point_range.hpp"
#include "synovia/contact/vertex_blocks.hpp"
#include "synovia/general/reduce.hpp"

#include <algorithm>
#include <cmath>

namespace synovia
{

using namespace mfem;

namespace
{
// A vertex that only grazes the source has no say: part of the largest area.
constexpr real_t grazes = 1e-8;
} // namespace

FiniteGap::FiniteGap(const ContactSurface &source,
                     const ContactSurface &destination,
                     const Vector &destination_areas, const GapOptions &options)
   : spaces(destination.Spaces()), pairing(source, destination, options),
     rim(destination, destination_areas, options.rim_coverage),
     derivatives(pairing, rim, inverse_area)
{
}

void FiniteGap::Search(const KeptBearing &kept)
{
   least_coverage = kept.least_coverage;
   pairing.Segment(kept.shares);
   CoverRim();
   Assemble();
   AssembleCoverage();
}

KeptBearing FiniteGap::FindBearing(real_t bearing_angle) const
{
   KeptBearing found;
   if (bearing_angle < M_PI)
   {
      found.shares = BearingShares(pairing, rim, bearing_angle);
   }
   found.least_coverage = rim.KeepingParts(CoveredArea(found.shares));
   return found;
}

void FiniteGap::Follow()
{
   if (pairing.Follow())
   {
      CoverRim();
   }
   Assemble();
}

void FiniteGap::GoBack()
{
   if (pairing.GoBack())
   {
      CoverRim();
   }
}

Vector FiniteGap::CoveredArea(const FaceShares &shares) const
{
   const ContactSurface &destination = pairing.Destination();
   VertexSums covered(destination.Vertices());
   Vector shapes;
   for (const PairedPoint &point : pairing.Points())
   {
      destination.GetVertexShapes(point.face, point.ip, shapes);
      for (int j = 0; j < shapes.Size(); j++)
      {
         shapes[j] *= ShareOf(shares, point.face, j);
      }
      covered.Add(destination.Faces()[point.face].Vertices(), point.area,
                  shapes);
   }
   return covered.OverRanks();
}

void FiniteGap::CoverRim()
{
   operators.own_area = CoveredArea(FaceShares());
   const FaceShares &shares = pairing.Shares();
   rim.Update(pairing,
              shares.empty() ? operators.own_area : CoveredArea(shares),
              least_coverage);
}

void FiniteGap::Assemble()
{
   const SurfaceVertices &m = pairing.Destination().Vertices();
   VertexSums areas(m);
   VertexSums gaps(m);
   VertexSums current(m);
   std::array<VertexSums, 3> normals{VertexSums(m), VertexSums(m),
                                     VertexSums(m)};
   std::array<VertexSums, 3> present_normals(normals);
   std::vector<Triplet> gap_entries;
   std::vector<Triplet> jump_entries;
   PairedPointShapes at(pairing);
   Vector phi;
   for (const PointRange &pair : GroupByFacePair(pairing.Points()))
   {
      at.Evaluate(pair.First());
      const FaceDofs &own = at.DestinationDofs();
      const FaceDofs &other = at.SourceDofs();
      const std::size_t rows = own.vertices.size();
      VertexBlock own_gap(rows, own.displacement.size());
      VertexBlock own_jump(rows, own.pressure.size());
      VertexBlock other_gap(rows, other.displacement.size());
      VertexBlock other_jump(rows, other.pressure.size());
      for (const PairedPoint &point : pair)
      {
         at.Evaluate(point);
         phi = at.Multiplier();
         phi *= point.area;
         own_gap.Add(phi, at.DestinationDisplacement(), at.Normal());
         own_jump.Add(phi, at.DestinationPressure());
         other_gap.Add(phi, at.SourceDisplacement(), at.Normal());
         other_jump.Add(phi, at.SourcePressure());
         areas.Add(at.Vertices(), 1.0, phi);
         gaps.Add(at.Vertices(), point.gap, phi);
         current.Add(at.Vertices(), at.Stretch(), phi);
         for (int d = 0; d < 3; d++)
         {
            normals[d].Add(at.Vertices(), at.Normal()[d], phi);
            present_normals[d].Add(at.Vertices(), at.Normal()[d] * at.Stretch(),
                                   phi);
         }
      }
      own_gap.AppendTo(-1.0, own.vertices, own.displacement, gap_entries);
      own_jump.AppendTo(-1.0, own.vertices, own.pressure, jump_entries);
      other_gap.AppendTo(1.0, own.vertices, other.displacement, gap_entries);
      other_jump.AppendTo(1.0, own.vertices, other.pressure, jump_entries);
   }
   const auto gathered = [&](const VertexSums &sums)
   {
      Vector all = sums.OverRanks();
      rim.Gather(all);
      return all;
   };
   operators.area = gathered(areas);
   gap = gathered(gaps);
   present_area = gathered(current);
   for (int d = 0; d < 3; d++)
   {
      operators.normal_area[d] = gathered(normals[d]);
      present_normal_area[d] = gathered(present_normals[d]);
   }
   const real_t largest = MaxOverRanks(
      operators.area.Size() > 0 ? operators.area.Max() : 0.0, spaces.GetComm());
   inverse_area.SetSize(operators.area.Size());
   for (int j = 0; j < inverse_area.Size(); j++)
   {
      real_t &area = operators.area[j];
      area = area > grazes * largest ? area : 0.0;
      inverse_area[j] = area > 0.0 ? 1.0 / area : 0.0;
   }
   gap *= inverse_area;
   operators.gap = AssembleRows(gap_entries, spaces.Displacement());
   operators.jump = AssembleRows(jump_entries, spaces.Pressure());
}

std::unique_ptr<HypreParMatrix>
FiniteGap::AssembleRows(const std::vector<Triplet> &entries,
                        ParFiniteElementSpace &columns) const
{
   const SurfaceVertices &m = pairing.Destination().Vertices();
   auto matrix =
      AssembleTriplets(spaces.GetComm(), entries, m.Offsets(), m.GlobalSize(),
                       columns.GetTrueDofOffsets(), columns.GlobalTrueVSize());
   rim.Gather(matrix);
   matrix->ScaleRows(inverse_area);
   return matrix;
}

void FiniteGap::AssembleCoverage()
{
   const SurfaceVertices &m = pairing.Destination().Vertices();
   VertexSums sizes(m);
   std::vector<Triplet> entries;
   operators.face_coverage.clear();
   PairedPointShapes at(pairing);
   Vector phi;
   for (const PointRange &on_face : GroupByFace(pairing.Points()))
   {
      FaceCoverage covered;
      covered.face = on_face.First().face;
      real_t hit_area = 0.0;
      for (const PairedPoint &point : on_face)
      {
         hit_area += point.area;
      }
      // The sum may be below zero for faces that are nearly along the normals.
      hit_area = std::max<real_t>(hit_area, 0.0);
      for (const PointRange &pair : GroupBySource(on_face))
      {
         at.Evaluate(pair.First());
         VertexBlock block(at.DestinationDofs().vertices.size(),
                           at.SourceDofs().vertices.size());
         for (const PairedPoint &point : pair)
         {
            at.Evaluate(point);
            phi = at.Multiplier();
            phi *= point.area;
            const bool square =
               at.DestinationDofs().geometry == Geometry::SQUARE;
            sizes.Add(at.Vertices(), std::sqrt((square ? 1.0 : 2.0) * hit_area),
                      phi);
            phi *= at.Stretch();
            for (int j = 0; j < phi.Size(); j++)
            {
               covered.area[j] += phi[j];
            }
            phi /= at.SourceStretch();
            block.Add(phi, at.SourceMultiplier());
         }
         block.AppendTo(1.0, at.DestinationDofs().vertices,
                        at.SourceDofs().vertices, entries);
      }
      operators.face_coverage.push_back(covered);
   }
   operators.face_size = sizes.OverRanks();
   rim.Gather(operators.face_size);
   operators.face_size *= inverse_area;
   for (Triplet &entry : entries)
   {
      std::swap(entry.row, entry.column);
   }
   const SurfaceVertices &covered_by = pairing.Source().Vertices();
   operators.coverage =
      AssembleTriplets(spaces.GetComm(), entries, covered_by.Offsets(),
                       covered_by.GlobalSize(), m.Offsets(), m.GlobalSize());
}

} // namespace synovia
