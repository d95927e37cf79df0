// ranks: 1 2 3
//
// A block that fills a notch is tied on both faces of it, by two ties that
// share the edge, where vertices belong to both. A uniform stress passes, all
// that is outside being displaced like that.

#include "synovia/general/reduce.hpp"
#include "synovia/synovia.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <functional>

using namespace mfem;
using namespace synovia;

namespace
{
constexpr real_t notch = 0.5;
constexpr real_t strain = 0.01;

bool IsInNotch(const Vector &x)
{
   return x[0] > notch && x[2] > notch;
}

/// Surfaces of a body: outside, and the faces of the notch across x and z.
enum Surface
{
   outside = 1,
   across_x,
   across_z
};

/// The unit cube without what is in the notch, or that.
Mesh Part(bool in_notch, const std::array<int, 3> &cells)
{
   Mesh cube =
      Mesh::MakeCartesian3D(cells[0], cells[1], cells[2], Element::HEXAHEDRON);
   for (int i = 0; i < cube.GetNE(); i++)
   {
      Vector center(3);
      cube.GetElementCenter(i, center);
      cube.SetAttribute(i, IsInNotch(center) == in_notch ? 1 : 2);
   }
   cube.SetAttributes();
   Array<int> wanted({1});
   Mesh part(SubMesh::CreateFromDomain(cube, wanted));
   for (int i = 0; i < part.GetNBE(); i++)
   {
      Array<int> vertices;
      part.GetBdrElementVertices(i, vertices);
      const auto is_in_plane = [&](int d)
      {
         return std::all_of(
            vertices.begin(), vertices.end(),
            [&](int v)
            { return std::abs(part.GetVertex(v)[d] - notch) < 1e-10; });
      };
      part.SetBdrAttribute(i, is_in_plane(0)   ? across_x
                              : is_in_plane(2) ? across_z
                                               : outside);
   }
   part.SetAttributes();
   return part;
}

NamedMesh NotchedCube()
{
   Mesh rest = Part(false, {4, 3, 4});
   Mesh block = Part(true, {6, 4, 6});
   for (int i = 0; i < block.GetNE(); i++)
   {
      block.SetAttribute(i, 2);
   }
   for (int i = 0; i < block.GetNBE(); i++)
   {
      block.SetBdrAttribute(i, 3 + block.GetBdrAttribute(i));
   }
   block.SetAttributes();
   Mesh *parts[] = {&rest, &block};
   Mesh both(parts, 2);
   return DistributeMesh(both, {{"rest", {1}}, {"block", {2}}},
                         {{"rest_outside", {1}},
                          {"rest_x", {2}},
                          {"rest_z", {3}},
                          {"block_outside", {4}},
                          {"block_x", {5}},
                          {"block_z", {6}}},
                         MPI_COMM_WORLD);
}

void Stretch(const Vector &x, Vector &u)
{
   u[0] = strain * (x[0] + 0.5 * x[2]);
   u[1] = -0.4 * strain * x[1];
   u[2] = strain * (0.3 * x[1] - x[2]);
}
} // namespace

TEST_CASE("A block is tied into a notch")
{
   const bool block_bears = GENERATE(true, false);
   const int order = GENERATE(1, 2);
   CAPTURE(block_bears, order);
   NamedMesh mesh = NotchedCube();
   const IsotropicElastic solid(0.5, 0.3);
   const ConstantPermeability fluid(4e-3);
   SpaceOptions space;
   space.order = order;
   BiphasicProblem problem(mesh, space);
   VectorFunctionCoefficient exact(3, Stretch);
   for (const std::string part : {"rest", "block"})
   {
      problem.SetMaterial(part, solid, fluid);
      problem.Conditions().PrescribeDisplacement(
         mesh.Boundary(part + "_outside"), exact);
      problem.PrescribePressure(part + "_outside", 0.0);
   }
   TieOptions options;
   options.displacement_tolerance = 1e-12;
   const std::string bearing = block_bears ? "block" : "rest";
   const std::string other = block_bears ? "rest" : "block";
   problem.AddTie({other + "_x"}, {bearing + "_x"}, options, "across x");
   problem.AddTie({other + "_z"}, {bearing + "_z"}, options, "across z");
   NonlinearOptions nonlinear;
   nonlinear.linear.method = LinearMethod::direct;
   nonlinear.linear.relative_tolerance = 1e-11;
   problem.SetNonlinearOptions(nonlinear);
   TimeOptions times;
   times.step = times.end = 1e11;
   TimeStepper stepper(problem, times);
   const StepReport report = stepper.Step();
   CAPTURE(report.reason);
   REQUIRE(report.converged);
   for (const TiedInterface *tie : problem.Operator().Interfaces())
   {
      CHECK(tie->Operators().covered == Approx(1.0).epsilon(1e-10));
   }
   ParGridFunction error(&problem.Spaces().Displacement());
   error.ProjectCoefficient(exact);
   error -= stepper.Displacement();
   CHECK(MaxOverRanks(error.Size() > 0 ? error.Normlinf() : 0.0,
                      mesh.GetComm()) <= 1e-9 * strain);
}
