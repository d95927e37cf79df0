#include "synovia/contact/gap_operators.hpp"
#include "synovia/contact/segmentation.hpp"
#include "synovia/contact/surface_search.hpp"
#include "synovia/general/parallel_triplets.hpp"

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

/// Values of the shape functions of a face's three fields at a point.
class FaceShapes
{
public:
   explicit FaceShapes(BiphasicSpaces &spaces)
      : fields{&spaces.Displacement(), &spaces.Pressure(), &spaces.Multiplier()}
   {
   }

   void Evaluate(Geometry::Type geometry, const IntegrationPoint &ip)
   {
      for (int f = 0; f < 3; f++)
      {
         const FiniteElement &element = FaceElement(*fields[f], geometry);
         // Spaces of one order have the same shape functions.
         if (f > 0 && element.GetOrder() == orders[f - 1])
         {
            which[f] = which[f - 1];
         }
         else
         {
            values[f].SetSize(element.GetDof());
            element.CalcShape(ip, values[f]);
            which[f] = f;
         }
         orders[f] = element.GetOrder();
      }
   }
   const Vector &Displacement() const { return values[which[0]]; }
   const Vector &Pressure() const { return values[which[1]]; }
   const Vector &Multiplier() const { return values[which[2]]; }

private:
   std::array<const ParFiniteElementSpace *, 3> fields;
   std::array<Vector, 3> values;
   std::array<int, 3> which{{0, 0, 0}};
   std::array<int, 3> orders{{0, 0, 0}};
};

// The part of an operator that one pair of faces contributes: rows are the
// destination face's vertices, columns the dofs of one face.
class FaceBlock
{
public:
   FaceBlock(int rows, size_t columns) : values(rows, static_cast<int>(columns))
   {
      values = 0.0;
   }

   /// Adds factor x weights to a column.
   void AddColumn(int column, real_t factor, const Vector &weights)
   {
      real_t *entries = values.GetColumn(column);
      for (int j = 0; j < weights.Size(); j++)
      {
         entries[j] += factor * weights[j];
      }
   }
   void AddPoint(const Vector &weights, const Vector &shape)
   {
      for (int k = 0; k < shape.Size(); k++)
      {
         AddColumn(k, shape[k], weights);
      }
   }
   /// Appends its entries times @a sign.
   void AddTo(real_t sign, const std::vector<HYPRE_BigInt> &rows,
              const std::vector<HYPRE_BigInt> &columns,
              std::vector<Triplet> &triplets) const
   {
      for (int j = 0; j < values.Width(); j++)
      {
         for (int i = 0; i < values.Height(); i++)
         {
            if (values(i, j) != 0.0)
            {
               triplets.push_back({rows[i], columns[j], sign * values(i, j)});
            }
         }
      }
   }

private:
   DenseMatrix values;
};

/// The blocks of gap and pressure jump.
struct FaceBlocks
{
   FaceBlocks(int rows, const FaceDofs &dofs)
      : gap(rows, dofs.displacement.size()), jump(rows, dofs.pressure.size())
   {
   }

   void AddPoint(const Vector &weights, const Point3 &normal,
                 const FaceShapes &shapes)
   {
      const Vector &u = shapes.Displacement();
      for (int k = 0; k < u.Size(); k++)
      {
         for (int d = 0; d < 3; d++)
         {
            gap.AddColumn(3 * k + d, normal[d] * u[k], weights);
         }
      }
      jump.AddPoint(weights, shapes.Pressure());
   }

   FaceBlock gap;
   FaceBlock jump;
};

struct SourceSide
{
   SourceSide(int rows, const FaceDofs &dofs_)
      : dofs(dofs_), blocks(rows, dofs), coverage(rows, dofs.vertices.size())
   {
   }
   const FaceDofs &dofs;
   FaceBlocks blocks;
   FaceBlock coverage;
};

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
          IsExpectedHit(hit.distance, point.distance, point.size);
}

class GapAssembler
{
public:
   GapAssembler(const ContactSurface &source_,
                const ContactSurface &destination_)
      : source(source_), destination(destination_),
        area(destination.Vertices().LocalSize()), offset(area.Size()),
        face_size(area.Size()), shapes(destination.Spaces())
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

   /// @a number: of the face in its ContactSurface.
   void AddFace(int number, const std::vector<SegmentPoint> &points,
                const SearchQuery *queries, const SearchHit *hits,
                const std::map<std::pair<int, int>, FaceDofs> &source_dofs);
   GapOperators Finish();

private:
   void AddSide(real_t sign, const std::vector<HYPRE_BigInt> &rows,
                const FaceBlocks &blocks, const FaceDofs &dofs)
   {
      blocks.gap.AddTo(sign, rows, dofs.displacement, gap);
      blocks.jump.AddTo(sign, rows, dofs.pressure, jump);
   }

   const ContactSurface &source;
   const ContactSurface &destination;
   std::vector<Triplet> gap;
   std::vector<Triplet> jump;
   std::vector<Triplet> coverage;
   Vector area;
   Vector offset;
   Vector face_size;
   std::vector<FaceCoverage> face_coverage;
   std::array<Vector, 3> normal_area;
   Vector phi;
   FaceShapes shapes;
};

void GapAssembler::AddFace(
   int number, const std::vector<SegmentPoint> &points,
   const SearchQuery *queries, const SearchHit *hits,
   const std::map<std::pair<int, int>, FaceDofs> &source_dofs)
{
   const DeformedFace &face = destination.Faces()[number];
   const FaceDofs own = GetFaceDofs(destination, number);
   const std::vector<HYPRE_BigInt> &rows = own.vertices;
   const int vertices = static_cast<int>(rows.size());
   FaceBlocks own_blocks(vertices, own);
   std::map<std::pair<int, int>, SourceSide> source_sides;
   std::pair<int, int> last_hit(-1, -1);
   SourceSide *side = nullptr;
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
      shapes.Evaluate(own.geometry, ip);
      phi = shapes.Multiplier();
      phi *= weight;
      own_blocks.AddPoint(phi, normal, shapes);

      // Points come source face by source face.
      const std::pair<int, int> source_face(hit.rank, hit.face);
      if (source_face != last_hit)
      {
         const FaceDofs &dofs = source_dofs.at(source_face);
         side = &source_sides.try_emplace(source_face, vertices, dofs)
                    .first->second;
         last_hit = source_face;
      }
      IntegrationPoint source_ip;
      source_ip.Set2(hit.xi, hit.eta);
      shapes.Evaluate(side->dofs.geometry, source_ip);
      side->blocks.AddPoint(phi, normal, shapes);
      side->coverage.AddPoint(phi, shapes.Multiplier());

      const real_t reference_gap =
         Dot(normal, Sum(hit.reference, -1.0, at.position));
      for (int j = 0; j < vertices; j++)
      {
         weights[j] += phi[j];
         offset[face.Vertices()[j]] += phi[j] * reference_gap;
         for (int d = 0; d < 3; d++)
         {
            normal_area[d][face.Vertices()[j]] += phi[j] * normal[d];
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
   FaceCoverage covered;
   covered.face = number;
   for (int j = 0; j < vertices; j++)
   {
      covered.area[j] = weights[j];
      area[face.Vertices()[j]] += weights[j];
      face_size[face.Vertices()[j]] += weights[j] * size;
   }
   face_coverage.push_back(covered);
   AddSide(-1.0, rows, own_blocks, own);
   for (const auto &[key, other] : source_sides)
   {
      AddSide(1.0, rows, other.blocks, other.dofs);
      other.coverage.AddTo(1.0, rows, other.dofs.vertices, coverage);
   }
}

GapOperators GapAssembler::Finish()
{
   BiphasicSpaces &spaces = destination.Spaces();
   const SurfaceVertices &m = destination.Vertices();
   ParFiniteElementSpace &u = spaces.Displacement();
   ParFiniteElementSpace &p = spaces.Pressure();
   GapOperators operators;
   operators.area = m.SumShared(area);
   operators.own_area = operators.area;
   operators.gap_offset = m.SumShared(offset);
   operators.face_size = m.SumShared(face_size);
   operators.face_coverage = std::move(face_coverage);
   for (int d = 0; d < 3; d++)
   {
      operators.normal_area[d] = m.SumShared(normal_area[d]);
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
      [&](const std::vector<Triplet> &triplets, ParFiniteElementSpace &columns)
   {
      return AssembleTriplets(spaces.GetComm(), triplets, m.Offsets(),
                              m.GlobalSize(), columns.GetTrueDofOffsets(),
                              columns.GlobalTrueVSize());
   };
   operators.gap = assemble(gap, u);
   operators.gap->ScaleRows(inverse);
   operators.jump = assemble(jump, p);
   operators.jump->ScaleRows(inverse);
   for (Triplet &triplet : coverage)
   {
      std::swap(triplet.row, triplet.column);
   }
   const SurfaceVertices &covered = source.Vertices();
   operators.coverage =
      AssembleTriplets(spaces.GetComm(), coverage, covered.Offsets(),
                       covered.GlobalSize(), m.Offsets(), m.GlobalSize());
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

   GapAssembler assembler(source, destination);
   size_t first = 0;
   for (size_t i = 0; i < segments.size(); i++)
   {
      assembler.AddFace(static_cast<int>(i), segments[i],
                        queries.data() + first, hits.data() + first,
                        source_dofs);
      first += segments[i].size();
   }
   return assembler.Finish();
}

void MultJump(const HypreParMatrix &map, const ContactSurface &destination,
              const Vector &p, Vector &jump, Vector &pressure)
{
   map.Mult(p, jump);
   p.HostRead();
   Vector destination_pressure(p.Size());
   destination_pressure = 0.0;
   for (const int dof : destination.PressureTrueDofs())
   {
      destination_pressure[dof] = -p[dof];
   }
   map.Mult(destination_pressure, pressure);
   jump.HostRead();
   pressure.HostRead();
}

Vector NodalAreas(const ContactSurface &surface)
{
   ParFiniteElementSpace &space = surface.Spaces().Multiplier();
   Vector local(surface.Vertices().LocalSize());
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
            local[face.Vertices()[j]] += weight * phi[j];
         }
      }
   }
   return surface.Vertices().SumShared(local);
}

} // namespace synovia
