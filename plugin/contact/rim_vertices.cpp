#include "synovia/contact/rim_vertices.hpp"
#include "synovia/contact/local_blocks.hpp"
#include "synovia/contact/paired_point_shapes.hpp"
#include "synovia/general/reduce.hpp"

namespace synovia
{

using namespace mfem;

namespace
{
/// int phi_i phi_j over what the points of a destination face stand for.
struct FaceOverlap
{
   Array<int> vertices;
   std::vector<HYPRE_BigInt> globals;
   DenseMatrix overlap;
};

std::vector<FaceOverlap> FaceOverlaps(const SurfacePairing &pairing)
{
   std::vector<FaceOverlap> overlaps;
   PairedPointShapes at(pairing);
   int face = -1;
   for (const PairedPoint &point : pairing.Points())
   {
      at.Evaluate(point);
      if (point.face != face)
      {
         face = point.face;
         overlaps.push_back({at.Vertices(), at.DestinationDofs().vertices,
                             DenseMatrix(at.VertexShapes().Size())});
         overlaps.back().overlap = 0.0;
      }
      AddMult_a_VVt(point.area, at.VertexShapes(), overlaps.back().overlap);
   }
   return overlaps;
}
} // namespace

RimVertices::RimVertices(const ContactSurface &destination_,
                         const Vector &whole_area_, real_t rim_coverage_)
   : destination(destination_), whole_area(whole_area_),
     rim_coverage(rim_coverage_)
{
}

void RimVertices::Update(const SurfacePairing &pairing,
                         const Vector &covered_area, const Vector &least)
{
   Vector at_rim(destination.Vertices().Size());
   for (int j = 0; j < at_rim.Size(); j++)
   {
      const real_t part = least.Size() > 0 ? least[j] : rim_coverage;
      const bool little = covered_area[j] < part * whole_area[j];
      at_rim[j] = covered_area[j] > 0.0 && little ? 1.0 : 0.0;
   }
   UpdateThose(pairing, at_rim);
}

Vector RimVertices::KeepingParts(const Vector &covered_area) const
{
   constexpr real_t to_leave = 2.0;
   constexpr real_t to_come = 0.25;
   Vector parts(covered_area.Size());
   for (int j = 0; j < parts.Size(); j++)
   {
      const bool little = covered_area[j] < rim_coverage * whole_area[j];
      const real_t factor = covered_area[j] == 0.0 ? 1.0
                            : little               ? to_leave
                                                   : to_come;
      parts[j] = factor * rim_coverage;
   }
   return parts;
}

void RimVertices::UpdateThose(const SurfacePairing &pairing,
                              const Vector &at_rim)
{
   const SurfaceVertices &m = destination.Vertices();
   MPI_Comm comm = destination.Spaces().GetComm();
   gathering.reset();
   if (!AnyRank(at_rim.Size() > 0 && at_rim.Max() > 0.0, comm))
   {
      return;
   }
   const Vector rim = m.Share(at_rim);
   const std::vector<FaceOverlap> overlaps = FaceOverlaps(pairing);
   Vector with_covered(m.LocalSize());
   with_covered = 0.0;
   for (const FaceOverlap &face : overlaps)
   {
      for (int j = 0; j < face.vertices.Size(); j++)
      {
         for (int i = 0; i < face.vertices.Size(); i++)
         {
            with_covered[face.vertices[j]] +=
               (1.0 - rim[face.vertices[i]]) * face.overlap(i, j);
         }
      }
   }
   const Vector own_total = m.SumShared(with_covered);
   const Vector total = m.Share(own_total);
   std::vector<Triplet> entries;
   const HYPRE_BigInt first = m.Offsets()[0];
   for (int j = 0; j < m.Size(); j++)
   {
      // One that has no covered vertex beside it stays on its own.
      if (at_rim[j] == 0.0 || own_total[j] == 0.0)
      {
         entries.push_back({first + j, first + j, 1.0});
      }
   }
   for (const FaceOverlap &face : overlaps)
   {
      for (int j = 0; j < face.vertices.Size(); j++)
      {
         const int vertex = face.vertices[j];
         for (int i = 0; i < face.vertices.Size(); i++)
         {
            if (rim[vertex] > 0.0 && total[vertex] > 0.0 &&
                rim[face.vertices[i]] == 0.0)
            {
               entries.push_back({face.globals[i], face.globals[j],
                                  face.overlap(i, j) / total[vertex]});
            }
         }
      }
   }
   gathering = AssembleTriplets(comm, entries, m.Offsets(), m.GlobalSize(),
                                m.Offsets(), m.GlobalSize());
}

void RimVertices::Gather(Vector &sums) const
{
   if (gathering)
   {
      const Vector shapes(sums);
      gathering->Mult(shapes, sums);
   }
}

void RimVertices::Gather(std::unique_ptr<HypreParMatrix> &sums) const
{
   if (gathering)
   {
      sums.reset(ParMult(gathering.get(), sums.get(), true));
   }
}

void RimVertices::Spread(Vector &values) const
{
   if (gathering)
   {
      const Vector multipliers(values);
      gathering->MultTranspose(multipliers, values);
   }
}

} // namespace synovia
