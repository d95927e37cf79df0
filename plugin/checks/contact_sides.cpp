#include "synovia/checks/contact_sides.hpp"
#include "synovia/checks/body_shape.hpp"
#include "synovia/checks/vertex_normals.hpp"
#include "synovia/general/reduce.hpp"
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
Box BoxOf(ParMesh &mesh, const Array<int> &surfaces)
{
   // Lows, and highs with their signs turned.
   std::vector<real_t> least(6, std::numeric_limits<real_t>::max());
   for (int i = 0; i < mesh.GetNBE(); i++)
   {
      if (surfaces.Find(mesh.GetBdrAttribute(i)) >= 0)
      {
         for (const Triangle &triangle : Triangulate(mesh, i))
         {
            for (const Point3 &corner : triangle)
            {
               for (int d = 0; d < 3; d++)
               {
                  least[d] = std::min(least[d], corner[d]);
                  least[3 + d] = std::min(least[3 + d], -corner[d]);
               }
            }
         }
      }
   }
   MinOverRanks(least, mesh.GetComm());
   Box box;
   box.Add(Point3{least[0], least[1], least[2]});
   box.Add(Point3{-least[3], -least[4], -least[5]});
   return box;
}

bool IsStraight(const ParMesh &mesh)
{
   return !mesh.GetNodes() || mesh.GetNodalFESpace()->GetMaxElementOrder() == 1;
}

/// Sums over the faces of a side, weighted by their areas.
struct SideSums
{
   real_t area = 0.0;
   real_t edge = 0.0;
   /// Of faces whose sagitta can be told.
   real_t told_area = 0.0;
   real_t sagitta = 0.0;

   void Reduce(MPI_Comm comm)
   {
      for (real_t *sum : {&area, &edge, &told_area, &sagitta})
      {
         *sum = SumOverRanks(*sum, comm);
      }
   }
};

// How far a flat face with these corners misses a smooth surface with the
// normals there, along the edge where it is most, unless all edges are at rims.
void AddSagitta(const FaceCorners &face, real_t area, SideSums &sums)
{
   real_t sagitta = -1.0;
   const size_t count = face.points.size();
   for (size_t i = 0; i < count; i++)
   {
      const size_t j = (i + 1) % count;
      if (face.smooth[i] && face.smooth[j])
      {
         const Point3 along = Sum(face.points[j], -1.0, face.points[i]);
         const Point3 turn = Sum(face.normals[j], -1.0, face.normals[i]);
         sagitta = std::max(sagitta, std::abs(Dot(turn, along)) / 8.0);
      }
   }
   if (sagitta >= 0.0)
   {
      sums.told_area += area;
      sums.sagitta += area * sagitta;
   }
}

class SideMeasurement
{
public:
   SideMeasurement(CaseProblem &problem_, const Array<int> &surfaces_)
      : problem(problem_), mesh(problem.Get().Mesh().Get()), surfaces(surfaces_)
   {
   }

   /// Of the faces whose centers are in the @a zone.
   ContactSide Measure(const Box &zone) const
   {
      const VertexNormals normals(problem.Get().Spaces(), surfaces);
      SideSums sums;
      real_t softest = std::numeric_limits<real_t>::infinity();
      for (int i = 0; i < mesh.GetNBE(); i++)
      {
         if (surfaces.Find(mesh.GetBdrAttribute(i)) < 0)
         {
            continue;
         }
         const Material &material =
            problem.Get().Materials().Get(RegionBehind(mesh, i));
         if (!material.IsRigid())
         {
            softest = std::min(softest, material.solid->AggregateModulus());
         }
         const FaceCorners face = normals.Corners(i);
         const Point3 center = face.Center();
         Box at;
         at.Add(center);
         if (at.Meets(zone))
         {
            Add(i, face, sums);
         }
      }
      sums.Reduce(mesh.GetComm());
      ContactSide side;
      side.modulus = -MaxOverRanks(-softest, mesh.GetComm());
      if (sums.area > 0.0)
      {
         side.edge = sums.edge / sums.area;
      }
      if (sums.told_area > 0.0)
      {
         side.sagitta = sums.sagitta / sums.told_area;
      }
      return side;
   }

private:
   void Add(int boundary_element, const FaceCorners &face, SideSums &sums) const
   {
      real_t area = 0.0;
      for (const Triangle &triangle : Triangulate(mesh, boundary_element))
      {
         area += 0.5 * Length(AreaVector(triangle));
      }
      // The edge of a square, or the legs of half of one.
      const real_t square = face.points.size() == 3 ? 2.0 * area : area;
      sums.area += area;
      sums.edge += area * std::sqrt(square);
      if (IsStraight(mesh))
      {
         AddSagitta(face, area, sums);
      }
   }

   CaseProblem &problem;
   ParMesh &mesh;
   const Array<int> &surfaces;
};
} // namespace

std::vector<ContactSides>
MeasureContactSides(const CaseFile &setup, CaseProblem &problem,
                    const std::vector<PairAtStart> &pairs)
{
   NamedMesh &named = problem.Get().Mesh();
   std::vector<ContactSides> all;
   for (size_t i = 0; i < pairs.size(); i++)
   {
      const Array<int> source =
         NamedBoundaries(named, setup.contacts[i].source);
      const Array<int> destination =
         NamedBoundaries(named, setup.contacts[i].destination);
      Box near_source = BoxOf(named.Get(), source);
      Box near_destination = BoxOf(named.Get(), destination);
      near_source.Inflate(pairs[i].search_radius);
      near_destination.Inflate(pairs[i].search_radius);
      all.push_back(
         {SideMeasurement(problem, source).Measure(near_destination),
          SideMeasurement(problem, destination).Measure(near_source)});
   }
   return all;
}

} // namespace synovia
