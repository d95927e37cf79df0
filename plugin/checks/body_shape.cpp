#include "synovia/checks/body_shape.hpp"
#include "synovia/general/reduce_lists.hpp"
#include "synovia/mesh/named_boundaries.hpp"
#include "synovia/mesh/triangulated_surface.hpp"

#include <algorithm>
#include <cmath>

namespace synovia
{

using namespace mfem;

namespace
{
bool Moves(const std::optional<LoadCurve> &displacement)
{
   if (!displacement)
   {
      return false;
   }
   const std::vector<real_t> &times = displacement->Corners();
   return std::any_of(times.begin(), times.end(),
                      [&](real_t t) { return (*displacement)(t) != 0.0; });
}

bool Presses(const BoundaryCase &boundary)
{
   return boundary.traction || boundary.normal_traction ||
          boundary.effective_traction || boundary.force.curve ||
          std::any_of(boundary.displacement.begin(),
                      boundary.displacement.end(), Moves);
}

Array<int> LoadedSurfaces(const CaseFile &setup, const NamedMesh &mesh)
{
   Array<int> loaded;
   for (const BoundaryCase &boundary : setup.boundaries)
   {
      if (Presses(boundary))
      {
         loaded.Append(NamedBoundaries(mesh, boundary.surfaces));
      }
   }
   return loaded;
}

/// A value and how much it counts.
struct Weighted
{
   real_t value;
   real_t weight;
};

real_t MedianOverRanks(const std::vector<Weighted> &mine, MPI_Comm comm)
{
   int ranks = 1;
   MPI_Comm_size(comm, &ranks);
   const int count = 2 * static_cast<int>(mine.size());
   std::vector<int> counts(ranks);
   MPI_Allgather(&count, 1, MPI_INT, counts.data(), 1, MPI_INT, comm);
   std::vector<int> first(ranks, 0);
   for (int r = 1; r < ranks; r++)
   {
      first[r] = first[r - 1] + counts[r - 1];
   }
   std::vector<Weighted> all((first.back() + counts.back()) / 2);
   const MPI_Datatype real = MPITypeMap<real_t>::mpi_type;
   MPI_Allgatherv(mine.data(), count, real, all.data(), counts.data(),
                  first.data(), real, comm);
   std::sort(all.begin(), all.end(),
             [](const Weighted &a, const Weighted &b)
             { return a.value < b.value; });
   real_t half = 0.0;
   for (const Weighted &entry : all)
   {
      half += 0.5 * entry.weight;
   }
   real_t below = 0.0;
   for (const Weighted &entry : all)
   {
      below += entry.weight;
      if (below >= half)
      {
         return entry.value;
      }
   }
   return 0.0;
}

// The ways through a body from its faces with the attributes.
std::vector<Weighted> WaysThrough(ParMesh &mesh, const Body &body,
                                  const TriangulatedSurface &outside,
                                  const Array<int> &attributes)
{
   std::vector<Weighted> ways;
   for (int i = 0; i < mesh.GetNBE(); i++)
   {
      if (attributes.Find(mesh.GetBdrAttribute(i)) < 0 ||
          !body.regions.count(RegionBehind(mesh, i)))
      {
         continue;
      }
      for (const Triangle &t : Triangulate(mesh, i))
      {
         const Point3 area = AreaVector(t);
         const real_t twice = Length(area);
         const Point3 center = Sum(
            Sum(Sum({0, 0, 0}, 1.0 / 3, t[0]), 1.0 / 3, t[1]), 1.0 / 3, t[2]);
         const real_t way =
            outside.WayThrough(center, Sum({0, 0, 0}, -1.0 / twice, area));
         if (std::isfinite(way))
         {
            ways.push_back({way, twice});
         }
      }
   }
   return ways;
}
} // namespace

Array<int> DrainingSurfaces(const CaseFile &setup, const NamedMesh &mesh)
{
   Array<int> draining = ContactSurfaces(setup, mesh);
   for (const BoundaryCase &boundary : setup.boundaries)
   {
      if (boundary.pressure)
      {
         draining.Append(NamedBoundaries(mesh, boundary.surfaces));
      }
   }
   return draining;
}

int RegionBehind(const ParMesh &mesh, int boundary_element)
{
   int element;
   int info;
   mesh.GetBdrElementAdjacentElement(boundary_element, element, info);
   return mesh.GetAttribute(element);
}

std::vector<int> BodyOfRegions(const std::vector<Body> &bodies, int attributes)
{
   std::vector<int> body_of(attributes + 1, -1);
   for (size_t b = 0; b < bodies.size(); b++)
   {
      for (const int region : bodies[b].regions)
      {
         body_of[region] = static_cast<int>(b);
      }
   }
   return body_of;
}

std::vector<real_t> MeasureThickness(const CaseFile &setup,
                                     CaseProblem &problem,
                                     const std::vector<Body> &bodies)
{
   NamedMesh &named = problem.Get().Mesh();
   ParMesh &mesh = named.Get();
   const Array<int> touching = ContactSurfaces(setup, named);
   const Array<int> loaded = LoadedSurfaces(setup, named);
   const Array<int> glued = GluedSurfaces(setup, named);
   std::vector<real_t> thickness;
   for (const Body &body : bodies)
   {
      const Array<int> &pressed = body.Touches(touching) ? touching : loaded;
      real_t median = 0.0;
      if (body.Touches(pressed))
      {
         const TriangulatedSurface outside(
            mesh,
            [&](int i)
            {
               return body.regions.count(RegionBehind(mesh, i)) > 0 &&
                      glued.Find(mesh.GetBdrAttribute(i)) < 0;
            });
         median = MedianOverRanks(WaysThrough(mesh, body, outside, pressed),
                                  named.GetComm());
      }
      thickness.push_back(median);
   }
   return thickness;
}

std::vector<real_t> MeasureDrainageLengths(const CaseFile &setup,
                                           CaseProblem &problem,
                                           const std::vector<Body> &bodies)
{
   NamedMesh &named = problem.Get().Mesh();
   ParMesh &mesh = named.Get();
   const int attributes = mesh.attributes.Max();
   const std::vector<int> body_of = BodyOfRegions(bodies, attributes);
   const Array<int> draining = DrainingSurfaces(setup, named);
   std::vector<TriangulatedSurface> outlets;
   for (size_t b = 0; b < bodies.size(); b++)
   {
      outlets.emplace_back(
         mesh,
         [&](int i)
         {
            return draining.Find(mesh.GetBdrAttribute(i)) >= 0 &&
                   body_of[RegionBehind(mesh, i)] == static_cast<int>(b);
         });
   }
   std::vector<real_t> lengths(attributes + 1, 0.0);
   std::vector<int> seen(mesh.GetNV(), -1);
   Array<int> vertices;
   for (int i = 0; i < mesh.GetNE(); i++)
   {
      const int region = mesh.GetAttribute(i);
      const TriangulatedSurface &outlet = outlets[body_of[region]];
      if (outlet.Empty())
      {
         continue;
      }
      const auto look_at = [&](const IntegrationPoint &ip)
      {
         Vector x(3);
         mesh.GetElementTransformation(i)->Transform(ip, x);
         lengths[region] =
            std::max(lengths[region],
                     outlet.Distance({x[0], x[1], x[2]}, lengths[region]));
      };
      const Geometry::Type geometry = mesh.GetElementGeometry(i);
      look_at(Geometries.GetCenter(geometry));
      mesh.GetElementVertices(i, vertices);
      for (int k = 0; k < vertices.Size(); k++)
      {
         if (seen[vertices[k]] != region)
         {
            seen[vertices[k]] = region;
            look_at(Geometries.GetVertices(geometry)->IntPoint(k));
         }
      }
   }
   MaxOverRanks(lengths, named.GetComm());
   return lengths;
}

} // namespace synovia
