// ranks: 1 2 3 4
//
// Two columns on top of each other, with meshes that do not match, consolidate
// as one column of double height does. The exact solution of the double column
// with two permeabilities is taken from one column that is meshed through.

#include "support/boxes.hpp"
#include "synovia/synovia.hpp"

#include <catch2/catch.hpp>

#include <cmath>

using namespace mfem;
using namespace synovia;

namespace
{
constexpr real_t height = 0.75;
constexpr real_t side = 0.3;

struct Materials
{
   explicit Materials(real_t upper_permeability)
      : solid(0.5417, 0.0833), lower(4.0e-3), upper(upper_permeability)
   {
   }
   IsotropicElastic solid;
   ConstantPermeability lower;
   ConstantPermeability upper;
};

void Confine(BiphasicProblem &problem, const std::string &prefix)
{
   for (const char *name : {"x0", "x1"})
   {
      problem.PrescribeDisplacement(prefix + name, 0, 0.0);
   }
   for (const char *name : {"y0", "y1"})
   {
      problem.PrescribeDisplacement(prefix + name, 1, 0.0);
   }
}

TimeOptions Times()
{
   TimeOptions options;
   options.end = 1000.0;
   options.step = 25.0;
   return options;
}

// Reaction of the top at each step. One column, whose upper half has another
// region, so that the permeability may jump.
std::vector<real_t> OneColumn(const Materials &materials)
{
   BoxOptions box;
   box.nz = 64;
   box.size_x = side;
   box.size_y = side;
   box.size_z = 2.0 * height;
   Mesh serial = MakeBoxMesh(box);
   for (int i = 0; i < serial.GetNE(); i++)
   {
      Vector center(3);
      serial.GetElementCenter(i, center);
      serial.SetAttribute(i, center[2] < height ? 1 : 2);
   }
   serial.SetAttributes();
   NamedMesh mesh = DistributeMesh(serial, {{"lower", {1}}, {"upper", {2}}},
                                   {{"z0", {1}},
                                    {"y0", {2}},
                                    {"x1", {3}},
                                    {"y1", {4}},
                                    {"x0", {5}},
                                    {"z1", {6}}},
                                   MPI_COMM_WORLD);
   BiphasicProblem problem(mesh, SpaceOptions());
   problem.SetMaterial("lower", materials.solid, materials.lower);
   problem.SetMaterial("upper", materials.solid, materials.upper);
   problem.FixDisplacement("z0");
   Confine(problem, "");
   problem.PrescribePressure("z1", 0.0);
   problem.PrescribeDisplacement("z1", 2, Ramp(500.0, -0.1));
   TimeStepper stepper(problem, Times());
   std::vector<real_t> reactions;
   while (!stepper.Done())
   {
      REQUIRE(stepper.Step().converged);
      reactions.push_back(problem.Reaction(problem.Supports().back())[2]);
   }
   return reactions;
}

std::vector<real_t> TwoColumns(const Materials &materials, Element::Type type,
                               int order, bool split_by_height)
{
   BoxOptions lower;
   lower.nx = 3;
   lower.ny = 3;
   lower.nz = 8;
   lower.type = type;
   lower.size_x = side;
   lower.size_y = side;
   lower.size_z = height;
   BoxOptions upper = lower;
   upper.nx = 2;
   upper.ny = 2;
   // The boundary layer under the drained top is to be resolved.
   upper.nz = order == 1 ? 24 : 11;
   upper.grading = 2.0;
   std::vector<int> partitioning;
   if (split_by_height)
   {
      // Each rank has a slab, so that most ranks own nothing of the surfaces
      // and no rank owns both sides.
      const int ranks = Mpi::WorldSize();
      Mesh serial = MakeStackMesh(lower, upper);
      for (int i = 0; i < serial.GetNE(); i++)
      {
         Vector center(3);
         serial.GetElementCenter(i, center);
         partitioning.push_back(std::min(
            ranks - 1, static_cast<int>(ranks * center[2] / (2 * height))));
      }
   }
   NamedMesh mesh =
      MakeStack(lower, upper, split_by_height ? partitioning.data() : nullptr);
   SpaceOptions space;
   space.order = order;
   BiphasicProblem problem(mesh, space);
   problem.SetMaterial("lower", materials.solid, materials.lower);
   problem.SetMaterial("upper", materials.solid, materials.upper);
   problem.FixDisplacement("lower_z0");
   Confine(problem, "lower_");
   Confine(problem, "upper_");
   problem.AddContact("upper_z0", "lower_z1");
   problem.PrescribePressure("upper_z1", 0.0);
   problem.PrescribeDisplacement("upper_z1", 2, Ramp(500.0, -0.1));
   TimeStepper stepper(problem, Times());
   std::vector<real_t> reactions;
   while (!stepper.Done())
   {
      const StepReport report = stepper.Step();
      CAPTURE(report.reason, report.time);
      REQUIRE(report.converged);
      reactions.push_back(problem.Reaction(problem.Supports().back())[2]);
      const ContactPair &pair = *problem.Operator().Pairs().front();
      const ContactDiagnostics contact = Diagnose(pair);
      CHECK(contact.area == Approx(side * side));
      CHECK(contact.penetration <= 1e-4 * height);
      CHECK(std::abs(contact.source_force[2] + contact.destination_force[2]) <=
            1e-10 * std::abs(contact.source_force[2]));
      // No fluid leaves between the columns: what the lower one loses is what
      // the upper one gets.
      const StageBalance &fluid = problem.Operator().Balance();
      CHECK(std::abs(fluid.error) <= 1e-6 * std::abs(fluid.outflow));
      CHECK(contact.fluid_exchange < 0.0);
   }
   return reactions;
}
} // namespace

TEST_CASE("Two stacked columns equal one column within 0.5 %")
{
   const real_t upper_permeability = GENERATE(4.0e-3, 8.0e-4);
   const Materials materials(upper_permeability);
   const std::vector<real_t> exact = OneColumn(materials);
   const auto type = GENERATE(Element::HEXAHEDRON, Element::TETRAHEDRON);
   const int order = GENERATE(1, 2);
   const bool split_by_height = GENERATE(false, true);
   CAPTURE(upper_permeability, static_cast<int>(type), order, split_by_height);
   const std::vector<real_t> found =
      TwoColumns(materials, type, order, split_by_height);
   REQUIRE(found.size() == exact.size());
   for (size_t i = 0; i < exact.size(); i++)
   {
      CAPTURE(i, exact[i], found[i]);
      CHECK(std::abs(found[i] - exact[i]) <= 5e-3 * std::abs(exact[i]));
   }
}
