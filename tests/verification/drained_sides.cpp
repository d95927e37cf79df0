// ranks: 1 2
//
// Two blocks on top of each other, drained at their sides, are squeezed as one
// block of double height is. The rim of the contact has its pressure from the
// sides: were it tied to the other block's, fluid would leak out there.

#include "support/boxes.hpp"
#include "synovia/synovia.hpp"

#include <catch2/catch.hpp>

#include <cmath>

using namespace mfem;
using namespace synovia;

namespace
{
constexpr real_t height = 0.5;

/// A quarter, with symmetry at x0 and y0.
BoxOptions Block(Element::Type type, int across, real_t size_z)
{
   BoxOptions box;
   box.nx = across;
   box.ny = across;
   box.nz = static_cast<int>(std::lround(4 * size_z / height));
   box.size_z = size_z;
   box.type = type;
   return box;
}

// The force on the top at each step.
std::vector<real_t> Squeeze(NamedMesh &mesh,
                            const std::vector<std::string> &blocks, int order)
{
   const IsotropicElastic solid(0.5417, 0.0833);
   const ConstantPermeability permeability(4.0e-3);
   SpaceOptions space;
   space.order = order;
   BiphasicProblem problem(mesh, space);
   for (const std::string &block : blocks)
   {
      const std::string prefix = blocks.size() > 1 ? block + "_" : "";
      problem.SetMaterial(block, solid, permeability);
      problem.PrescribeDisplacement(prefix + "x0", 0, 0.0);
      problem.PrescribeDisplacement(prefix + "y0", 1, 0.0);
      problem.PrescribePressure(prefix + "x1", 0.0);
      problem.PrescribePressure(prefix + "y1", 0.0);
   }
   if (blocks.size() > 1)
   {
      problem.AddContact("upper_z0", "lower_z1");
   }
   const bool two = blocks.size() > 1;
   problem.FixDisplacement(two ? "lower_z0" : "z0");
   problem.PrescribeDisplacement(two ? "upper_z1" : "z1", 0, 0.0);
   problem.PrescribeDisplacement(two ? "upper_z1" : "z1", 1, 0.0);
   problem.PrescribeDisplacement(two ? "upper_z1" : "z1", 2, Ramp(40.0, -0.05));
   TimeOptions times;
   times.step = 10.0;
   times.end = 80.0;
   TimeStepper stepper(problem, times);
   std::vector<real_t> force;
   while (!stepper.Done())
   {
      const StepReport report = stepper.Step();
      CAPTURE(report.reason, report.time);
      REQUIRE(report.converged);
      force.push_back(problem.Reaction(problem.Supports().back())[2]);
   }
   return force;
}
} // namespace

TEST_CASE("Two blocks with drained sides equal one")
{
   const auto type = GENERATE(Element::HEXAHEDRON, Element::TETRAHEDRON);
   const int order = GENERATE(1, 2, 3);
   CAPTURE(static_cast<int>(type), order);
   const int across = order == 1 ? 9 : 3;
   NamedMesh one = MakeBox(Block(type, across, 2 * height));
   NamedMesh two = MakeStack(Block(type, across, height),
                             Block(type, 2 * across / 3, height));
   const std::vector<real_t> exact = Squeeze(one, {"body"}, order);
   const std::vector<real_t> found = Squeeze(two, {"lower", "upper"}, order);
   REQUIRE(found.size() == exact.size());
   for (size_t i = 0; i < exact.size(); i++)
   {
      CAPTURE(i);
      CHECK(found[i] == Approx(exact[i]).epsilon(0.01));
   }
}
