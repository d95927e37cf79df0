#include "synovia/checks/contact_grip.hpp"
#include "synovia/checks/body_shape.hpp"
#include "synovia/checks/layer_loads.hpp"
#include "synovia/checks/vertex_normals.hpp"
#include "synovia/fem/null_space.hpp"
#include "synovia/general/reduce_lists.hpp"
#include "synovia/mesh/named_boundaries.hpp"

#include <cmath>
#include <numeric>

namespace synovia
{

using namespace mfem;

namespace
{
constexpr int per_body = RigidMotions::per_body;
// Contact pushes along a motion if its surfaces sweep at least this part of
// what they would along their normals.
constexpr real_t least_part = 0.02;
// Surfaces slide in a motion whose normal components have a mean square below
// this, the farthest point moving by about 1: flat faces of a round surface
// don't hold it.
constexpr real_t slides = 1e-3;
// Smaller parts of a sliding motion are errors of such faces.
constexpr real_t facets = 0.05;
} // namespace

ContactGrip::ContactGrip(const CaseFile &setup, CaseProblem &problem,
                         const std::vector<Body> &bodies,
                         const RigidMotions &motions_)
   : motions(motions_), comm(problem.Get().Spaces().GetComm()),
     areas(bodies.size(), 0.0), loads(bodies.size())
{
   const NamedMesh &mesh = problem.Get().Mesh();
   const Array<int> surfaces = ContactSurfaces(setup, mesh);
   AddCorners(surfaces, problem.Get().Spaces(), bodies);
   for (size_t b = 0; b < bodies.size(); b++)
   {
      loads[b].contact = bodies[b].Touches(surfaces);
      for (const BoundaryCase &boundary : setup.boundaries)
      {
         Array<int> on;
         for (const std::string &name : boundary.surfaces)
         {
            on.Append(mesh.Boundary(name));
         }
         if (bodies[b].Touches(on))
         {
            AddLoads(boundary, loads[b]);
         }
      }
      for (const RigidBodyCase &body : setup.rigid_bodies)
      {
         if (bodies[b].Touches(TiedSurfaces(body, mesh)))
         {
            AddLoads(body.Options(), loads[b]);
         }
      }
   }
}

void ContactGrip::AddCorners(const Array<int> &surfaces, BiphasicSpaces &spaces,
                             const std::vector<Body> &bodies)
{
   const ParMesh &mesh = spaces.GetMesh();
   const std::vector<int> body_of =
      BodyOfRegions(bodies, mesh.attributes.Max());
   const VertexNormals normals(spaces, surfaces);
   for (int i = 0; i < mesh.GetNBE(); i++)
   {
      if (surfaces.Find(mesh.GetBdrAttribute(i)) < 0)
      {
         continue;
      }
      const FaceCorners face = normals.Corners(i);
      const int body = body_of[RegionBehind(mesh, i)];
      const real_t area = Length(face.AreaVector());
      areas[body] += area;
      for (size_t k = 0; k < face.points.size(); k++)
      {
         corners.push_back(
            {body, face.points[k],
             Sum({0.0, 0.0, 0.0}, area / face.points.size(), face.Normal(k))});
      }
   }
   SumOverRanks(areas, comm);
}

void ContactGrip::AddLoads(const BoundaryCase &boundary, Loads &of_body) const
{
   for (int d = 0; d < 3; d++)
   {
      of_body.driven[d] = of_body.driven[d] || boundary.force.Drives(d);
      of_body.loaded[d] =
         of_body.loaded[d] || of_body.driven[d] || boundary.normal_traction ||
         boundary.effective_traction ||
         (boundary.traction && Amplitude((*boundary.traction)[d]) > 0.0);
   }
}

void ContactGrip::AddLoads(const RigidBodyOptions &body, Loads &of_body) const
{
   // Forces also make moments, and moments press by what they turn.
   bool turned = false;
   for (int i = 3; i < 6; i++)
   {
      turned = turned || Amplitude(body.load[i]) > 0.0;
   }
   for (int d = 0; d < 3; d++)
   {
      const bool pushed = Amplitude(body.load[d]) > 0.0;
      of_body.driven[d] = of_body.driven[d] || pushed;
      of_body.loaded[d] = of_body.loaded[d] || pushed || turned;
   }
}

std::array<real_t, per_body> ContactGrip::Swept(const Corner &corner) const
{
   std::array<real_t, per_body> swept;
   for (int m = 0; m < per_body; m++)
   {
      swept[m] = Dot(corner.area, motions.At(corner.body, m, corner.place));
   }
   return swept;
}

ContactGrip::Motions ContactGrip::Split(const std::vector<Vector> &free) const
{
   const int size = static_cast<int>(free.size());
   std::vector<real_t> sums(size * size, 0.0);
   Vector swept(size);
   for (const Corner &corner : corners)
   {
      const std::array<real_t, per_body> each = Swept(corner);
      for (int i = 0; i < size; i++)
      {
         swept[i] =
            std::inner_product(each.begin(), each.end(),
                               free[i].GetData() + per_body * corner.body, 0.0);
      }
      const real_t weight = 1.0 / (Length(corner.area) * areas[corner.body]);
      for (int i = 0; i < size * size; i++)
      {
         sums[i] += weight * swept[i % size] * swept[i / size];
      }
   }
   SumOverRanks(sums, comm);
   const DenseMatrix resistance(sums.data(), size, size);
   Motions split;
   for (const Vector &factors : NullSpace(resistance, slides))
   {
      split.sliding.emplace_back(per_body * motions.Bodies());
      split.sliding.back() = 0.0;
      for (int i = 0; i < size; i++)
      {
         if (std::abs(factors[i]) > facets)
         {
            split.sliding.back().Add(factors[i], free[i]);
         }
      }
   }
   for (const int i : IndependentColumns(resistance, slides))
   {
      split.resisted.push_back(free[i]);
   }
   return split;
}

bool ContactGrip::FromOneSide(const Vector &motion) const
{
   std::vector<real_t> swept(2, 0.0);
   for (const Corner &corner : corners)
   {
      const std::array<real_t, per_body> each = Swept(corner);
      const real_t out =
         std::inner_product(each.begin(), each.end(),
                            motion.GetData() + per_body * corner.body, 0.0) /
         areas[corner.body];
      swept[out > 0.0 ? 0 : 1] += std::abs(out);
   }
   SumOverRanks(swept, comm);
   return (swept[0] > least_part) != (swept[1] > least_part);
}

bool ContactGrip::Any(const std::array<bool, 3> &axes, int body,
                      const Vector &motion) const
{
   const real_t *const factors = motion.GetData() + per_body * body;
   const bool turns = motions.Direction(body, factors).turns;
   bool any = false;
   for (int d = 0; d < 3; d++)
   {
      any = any || (axes[d] && (turns || factors[d] != 0.0));
   }
   return any;
}

bool ContactGrip::IsLoaded(int body, const Vector &motion) const
{
   return Any(loads[body].loaded, body, motion);
}

bool ContactGrip::IsDriven(int body, const Vector &motion) const
{
   return Any(loads[body].driven, body, motion);
}

} // namespace synovia
