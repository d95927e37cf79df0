#include "contact/gap_operators.hpp"
#include "contact/parallel_triplets.hpp"
#include "contact/segmentation.hpp"
#include "contact/surface_search.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace synovia
{

using namespace mfem;

namespace
{
const FiniteElement &FaceElement(const ParFiniteElementSpace &space,
                                 Geometry::Type geometry)
{
   return *space.FEColl()->FiniteElementForGeometry(geometry);
}

// Sums a vector of local dofs over the ranks that share them.
Vector SumShared(ParFiniteElementSpace &space, const Vector &local)
{
   Vector result(space.GetTrueVSize());
   space.GetProlongationMatrix()->MultTranspose(local, result);
   // What belongs to a contact is evaluated on the host.
   result.HostReadWrite();
   result.UseDevice(false);
   return result;
}

// The part of the operators that one pair of faces contributes: rows are the
// destination face's vertices, columns the dofs of one face.
class FaceBlock
{
public:
   FaceBlock(int rows, int columns) : values(rows, columns) { values = 0.0; }

   void AddTo(const std::vector<HYPRE_BigInt> &rows,
              const std::vector<HYPRE_BigInt> &columns,
              std::vector<Triplet> &triplets) const
   {
      for (int i = 0; i < values.Height(); i++)
      {
         for (int j = 0; j < values.Width(); j++)
         {
            if (values(i, j) != 0.0)
            {
               triplets.push_back({rows[i], columns[j], values(i, j)});
            }
         }
      }
   }

   DenseMatrix values;
};

struct FaceBlocks
{
   FaceBlocks(int rows, const FaceDofs &dofs)
      : gap(rows, static_cast<int>(dofs.displacement.size())),
        jump(rows, static_cast<int>(dofs.pressure.size())),
        coverage(rows, static_cast<int>(dofs.multiplier.size()))
   {
   }
   FaceBlock gap;
   FaceBlock jump;
   FaceBlock coverage;
};

std::vector<HYPRE_BigInt> Global(ParFiniteElementSpace &space,
                                 const Array<int> &dofs)
{
   std::vector<HYPRE_BigInt> result;
   result.reserve(dofs.Size());
   for (const int dof : dofs)
   {
      result.push_back(space.GetGlobalTDofNumber(dof));
   }
   return result;
}

// A hit that is farther than this part of the source face's size from where the
// face should be is one of another part of the source, in between.
constexpr real_t in_between = 0.5;

using Segments = std::vector<std::vector<SegmentPoint>>;

std::vector<SearchQuery> MakeQueries(const ContactSurface &destination,
                                     const Segments &segments)
{
   std::vector<SearchQuery> queries;
   for (size_t i = 0; i < segments.size(); i++)
   {
      const DeformedFace &face = destination.Faces()[i];
      for (const SegmentPoint &point : segments[i])
      {
         queries.push_back({face.Current(point.ip).position,
                            face.Reference(point.ip).UnitNormal(), point.rank,
                            point.face});
      }
   }
   return queries;
}

/// Turns the queries from the destination's normal to the mean of both.
void TakeMeanNormals(const std::vector<SearchHit> &hits,
                     std::vector<SearchQuery> &queries)
{
   for (size_t i = 0; i < hits.size(); i++)
   {
      if (hits[i].Found())
      {
         const Point3 sum = Sum(queries[i].normal, -1.0, hits[i].normal);
         const real_t length = Length(sum);
         queries[i].normal = {sum[0] / length, sum[1] / length,
                              sum[2] / length};
      }
   }
}

bool Counts(const SearchHit &hit, const SegmentPoint &point)
{
   return hit.Found() &&
          std::abs(hit.distance - point.distance) <= in_between * point.size;
}

class GapAssembler
{
public:
   GapAssembler(BiphasicSpaces &spaces_)
      : spaces(spaces_), area(spaces.Multiplier().GetVSize()),
        offset(area.Size()), face_size(area.Size())
   {
      area = 0.0;
      offset = 0.0;
      face_size = 0.0;
      for (Vector &component : normal_area)
      {
         component.SetSize(area.Size());
         component = 0.0;
      }
   }

   void AddFace(const DeformedFace &face,
                const std::vector<SegmentPoint> &points,
                const SearchQuery *queries, const SearchHit *hits,
                const std::map<std::pair<int, int>, FaceDofs> &source_dofs);
   GapOperators Finish();

private:
   void AddSide(const std::vector<HYPRE_BigInt> &rows, const FaceBlocks &blocks,
                const FaceDofs &dofs)
   {
      blocks.gap.AddTo(rows, dofs.displacement, gap);
      blocks.jump.AddTo(rows, dofs.pressure, jump);
   }

   BiphasicSpaces &spaces;
   std::vector<Triplet> gap;
   std::vector<Triplet> jump;
   std::vector<Triplet> coverage;
   Vector area;
   Vector offset;
   Vector face_size;
   std::array<Vector, 3> normal_area;
   Vector phi;
   Vector u_shape;
   Vector p_shape;
   Vector m_shape;
};

void EvaluateShapes(BiphasicSpaces &spaces, Geometry::Type geometry,
                    const IntegrationPoint &ip, Vector &u, Vector &p, Vector &m)
{
   // Spaces of one order have the same shape functions.
   const FiniteElement *last = nullptr;
   const auto evaluate = [&](const ParFiniteElementSpace &space, Vector &shape,
                             const Vector &before)
   {
      const FiniteElement &element = FaceElement(space, geometry);
      if (last && last->GetOrder() == element.GetOrder())
      {
         shape = before;
         return;
      }
      shape.SetSize(element.GetDof());
      element.CalcShape(ip, shape);
      last = &element;
   };
   evaluate(spaces.Displacement(), u, u);
   evaluate(spaces.Pressure(), p, u);
   evaluate(spaces.Multiplier(), m, p);
}

void AddPoint(FaceBlocks &blocks, const Vector &phi, real_t weight,
              const Point3 &normal, const Vector &u, const Vector &p,
              const Vector &m)
{
   for (int j = 0; j < phi.Size(); j++)
   {
      const real_t w = weight * phi[j];
      for (int k = 0; k < u.Size(); k++)
      {
         for (int d = 0; d < 3; d++)
         {
            blocks.gap.values(j, 3 * k + d) += w * normal[d] * u[k];
         }
      }
      for (int k = 0; k < p.Size(); k++)
      {
         blocks.jump.values(j, k) += w * p[k];
      }
      for (int k = 0; k < m.Size(); k++)
      {
         blocks.coverage.values(j, k) += w * m[k];
      }
   }
}

void GapAssembler::AddFace(
   const DeformedFace &face, const std::vector<SegmentPoint> &points,
   const SearchQuery *queries, const SearchHit *hits,
   const std::map<std::pair<int, int>, FaceDofs> &source_dofs)
{
   const std::vector<HYPRE_BigInt> rows =
      Global(spaces.Multiplier(), face.MultiplierDofs());
   const FaceDofs own{face.GetGeometry(),
                      Global(spaces.Displacement(), face.DisplacementDofs()),
                      Global(spaces.Pressure(), face.PressureDofs()), rows};
   const int vertices = static_cast<int>(rows.size());
   FaceBlocks own_blocks(vertices, own);
   std::map<std::pair<int, int>, FaceBlocks> source_blocks;
   real_t hit_area = 0.0;
   Vector weights(vertices);
   weights = 0.0;

   for (size_t q = 0; q < points.size(); q++)
   {
      const SearchHit &hit = hits[q];
      if (!Counts(hit, points[q]))
      {
         continue;
      }
      const IntegrationPoint &ip = points[q].ip;
      const Point3 &normal = queries[q].normal;
      const SurfacePoint at = face.Reference(ip);
      const real_t weight = ip.weight * at.AreaFactor();
      EvaluateShapes(spaces, own.geometry, ip, u_shape, p_shape, m_shape);
      phi = m_shape;
      AddPoint(own_blocks, phi, -weight, normal, u_shape, p_shape, m_shape);

      const FaceDofs &dofs = source_dofs.at({hit.rank, hit.face});
      FaceBlocks &blocks =
         source_blocks.try_emplace({hit.rank, hit.face}, vertices, dofs)
            .first->second;
      IntegrationPoint source_ip;
      source_ip.Set2(hit.xi, hit.eta);
      EvaluateShapes(spaces, dofs.geometry, source_ip, u_shape, p_shape,
                     m_shape);
      AddPoint(blocks, phi, weight, normal, u_shape, p_shape, m_shape);

      const real_t reference_gap =
         Dot(normal, Sum(hit.reference, -1.0, at.position));
      for (int j = 0; j < vertices; j++)
      {
         weights[j] += weight * phi[j];
         offset[face.MultiplierDofs()[j]] += weight * phi[j] * reference_gap;
         for (int d = 0; d < 3; d++)
         {
            normal_area[d][face.MultiplierDofs()[j]] +=
               weight * phi[j] * normal[d];
         }
      }
      hit_area += weight;
   }
   if (hit_area == 0.0)
   {
      return;
   }
   const real_t size =
      std::sqrt(hit_area * (own.geometry == Geometry::TRIANGLE ? 2.0 : 1.0));
   for (int j = 0; j < vertices; j++)
   {
      area[face.MultiplierDofs()[j]] += weights[j];
      face_size[face.MultiplierDofs()[j]] += weights[j] * size;
   }
   AddSide(rows, own_blocks, own);
   for (const auto &[key, blocks] : source_blocks)
   {
      const FaceDofs &dofs = source_dofs.at(key);
      AddSide(rows, blocks, dofs);
      blocks.coverage.AddTo(rows, dofs.multiplier, coverage);
   }
}

GapOperators GapAssembler::Finish()
{
   ParFiniteElementSpace &m = spaces.Multiplier();
   ParFiniteElementSpace &u = spaces.Displacement();
   ParFiniteElementSpace &p = spaces.Pressure();
   GapOperators operators;
   operators.area = SumShared(m, area);
   operators.gap_offset = SumShared(m, offset);
   operators.face_size = SumShared(m, face_size);
   for (int d = 0; d < 3; d++)
   {
      operators.normal_area[d] = SumShared(m, normal_area[d]);
   }
   // A vertex that only grazes the source has no say.
   real_t largest = operators.area.Size() > 0 ? operators.area.Max() : 0.0;
   MPI_Allreduce(MPI_IN_PLACE, &largest, 1, MPITypeMap<real_t>::mpi_type,
                 MPI_MAX, spaces.GetComm());
   Vector inverse(operators.area.Size());
   for (int j = 0; j < inverse.Size(); j++)
   {
      if (operators.area[j] <= 1e-8 * largest)
      {
         operators.area[j] = 0.0;
      }
      inverse[j] = operators.area[j] > 0.0 ? 1.0 / operators.area[j] : 0.0;
   }
   operators.gap_offset *= inverse;
   operators.face_size *= inverse;

   const auto assemble =
      [&](std::vector<Triplet> &triplets, ParFiniteElementSpace &columns)
   {
      auto matrix = AssembleTriplets(spaces.GetComm(), std::move(triplets),
                                     m.GetTrueDofOffsets(), m.GlobalTrueVSize(),
                                     columns.GetTrueDofOffsets(),
                                     columns.GlobalTrueVSize());
      return matrix;
   };
   operators.gap = assemble(gap, u);
   operators.gap->ScaleRows(inverse);
   operators.jump = assemble(jump, p);
   operators.jump->ScaleRows(inverse);
   for (Triplet &triplet : coverage)
   {
      std::swap(triplet.row, triplet.column);
   }
   operators.coverage = assemble(coverage, m);
   return operators;
}
} // namespace

GapOperators AssembleGapOperators(const ContactSurface &source,
                                  const ContactSurface &destination,
                                  const GapOptions &options)
{
   const SurfaceSearch search(source, options.search_radius);
   const Segments segments = SegmentSurface(
      source, destination, options.search_radius, options.quadrature_order);
   std::vector<SearchQuery> queries = MakeQueries(destination, segments);
   std::vector<SearchHit> hits = search.Find(queries);
   if (options.normal == ContactNormal::mean)
   {
      TakeMeanNormals(hits, queries);
      hits = search.Find(queries);
   }

   std::map<std::pair<int, int>, FaceDofs> source_dofs;
   for (const SearchHit &hit : hits)
   {
      if (hit.Found())
      {
         source_dofs[{hit.rank, hit.face}];
      }
   }
   std::vector<std::pair<int, int>> wanted;
   wanted.reserve(source_dofs.size());
   for (const auto &entry : source_dofs)
   {
      wanted.push_back(entry.first);
   }
   std::vector<FaceDofs> received = search.GetFaceDofs(wanted);
   for (size_t i = 0; i < wanted.size(); i++)
   {
      source_dofs[wanted[i]] = std::move(received[i]);
   }

   GapAssembler assembler(destination.Spaces());
   size_t first = 0;
   for (size_t i = 0; i < segments.size(); i++)
   {
      assembler.AddFace(destination.Faces()[i], segments[i],
                        queries.data() + first, hits.data() + first,
                        source_dofs);
      first += segments[i].size();
   }
   return assembler.Finish();
}

Vector NodalAreas(const ContactSurface &surface)
{
   ParFiniteElementSpace &space = surface.Spaces().Multiplier();
   Vector local(space.GetVSize());
   local = 0.0;
   Vector phi;
   for (const DeformedFace &face : surface.Faces())
   {
      const FiniteElement &element = FaceElement(space, face.GetGeometry());
      phi.SetSize(element.GetDof());
      // Curved faces have weights beyond polynomials: orders to spare.
      const IntegrationRule &rule = IntRules.Get(face.GetGeometry(), 8);
      for (int q = 0; q < rule.GetNPoints(); q++)
      {
         const IntegrationPoint &ip = rule.IntPoint(q);
         element.CalcShape(ip, phi);
         const real_t weight = ip.weight * face.Reference(ip).AreaFactor();
         for (int j = 0; j < phi.Size(); j++)
         {
            local[face.MultiplierDofs()[j]] += weight * phi[j];
         }
      }
   }
   return SumShared(space, local);
}

} // namespace synovia
