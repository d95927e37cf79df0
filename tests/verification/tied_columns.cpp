// ranks: 1 2
// timeout: 600
//
// Two columns of different permeability, glued on top of each other with meshes
// that don't match, consolidate as one column of two layers that is meshed
// through: in infinitesimal deformation, in all time schemes, and in finite
// deformation up to 30 % of compression. With a lower half that is elastic and
// has no fluid, nothing enters it, as in a mesh that is one.

#include "support/boxes.hpp"
#include "synovia/synovia.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

using namespace mfem;
using namespace synovia;

namespace
{
constexpr real_t height = 0.75;
constexpr real_t side = 0.3;

struct Column
{
   Deformation deformation = Deformation::infinitesimal;
   Element::Type type = Element::HEXAHEDRON;
   int order = 2;
   TimeScheme scheme = TimeScheme::backward_euler;
   /// Without: the lower half is dry.
   std::optional<real_t> lower_permeability = 4.0e-3;
   real_t upper_permeability = 8.0e-4;
   real_t descent = 0.1;
   LinearMethod method = LinearMethod::direct;
};

struct Laws
{
   explicit Laws(const Column &column)
      : linear(0.5, 0.1), finite(0.5, 0.1), stiff_linear(1.5, 0.2),
        stiff_finite(1.5, 0.2), lower(column.lower_permeability.value_or(1.0)),
        upper(column.upper_permeability)
   {
   }
   IsotropicElastic linear;
   NeoHookean finite;
   IsotropicElastic stiff_linear;
   NeoHookean stiff_finite;
   ConstantPermeability lower;
   ConstantPermeability upper;
};

struct Row
{
   real_t reaction = 0.0;
   real_t outflow = 0.0;
};

void SetUp(const Column &column, const Laws &laws, const std::string &bottom,
           const std::string &top, const std::vector<std::string> &prefixes,
           BiphasicProblem &problem)
{
   const bool finite = column.deformation == Deformation::finite;
   const SolidLaw &soft =
      finite ? static_cast<const SolidLaw &>(laws.finite) : laws.linear;
   const SolidLaw &stiff = finite
                              ? static_cast<const SolidLaw &>(laws.stiff_finite)
                              : laws.stiff_linear;
   if (column.lower_permeability)
   {
      problem.SetMaterial("lower", stiff, laws.lower);
   }
   else
   {
      problem.SetMaterial("lower", stiff);
   }
   problem.SetMaterial("upper", soft, laws.upper);
   for (const std::string &prefix : prefixes)
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
   problem.FixDisplacement(bottom);
   problem.PrescribePressure(top, 0.0);
   problem.PrescribeDisplacement(top, 2, Ramp(500.0, -column.descent));
   NonlinearOptions nonlinear;
   nonlinear.linear.method = column.method;
   problem.SetNonlinearOptions(nonlinear);
}

TimeOptions Times(const Column &column)
{
   TimeOptions options;
   options.end = 1000.0;
   options.step = 50.0;
   options.scheme = column.scheme;
   return options;
}

SpaceOptions Space(const Column &column, int order)
{
   SpaceOptions space;
   space.order = order;
   space.deformation = column.deformation;
   return space;
}

Row RowOf(BiphasicProblem &problem)
{
   return {problem.Reaction(problem.Supports().back())[2],
           problem.Operator().Balance().outflow};
}

/// One mesh through both layers.
std::vector<Row> Whole(const Column &column)
{
   BoxOptions box;
   box.nz = 32;
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
   const Laws laws(column);
   BiphasicProblem problem(mesh, Space(column, 2));
   SetUp(column, laws, "z0", "z1", {""}, problem);
   TimeStepper stepper(problem, Times(column));
   std::vector<Row> rows;
   while (!stepper.Done())
   {
      REQUIRE(stepper.Step().converged);
      rows.push_back(RowOf(problem));
   }
   return rows;
}

std::vector<Row> Tied(const Column &column)
{
   BoxOptions lower;
   lower.nx = 3;
   lower.ny = 3;
   lower.nz = column.order == 1 ? 16 : 6;
   lower.type = column.type;
   lower.size_x = side;
   lower.size_y = side;
   lower.size_z = height;
   BoxOptions upper = lower;
   upper.nx = 2;
   upper.ny = 2;
   upper.nz = column.order == 1 ? 24 : 11;
   upper.grading = column.order == 1 ? 1.5 : 1.2;
   NamedMesh mesh = MakeStack(lower, upper);
   const Laws laws(column);
   BiphasicProblem problem(mesh, Space(column, column.order));
   SetUp(column, laws, "lower_z0", "upper_z1", {"lower_", "upper_"}, problem);
   problem.AddTie({"upper_z0"}, {"lower_z1"}, TieOptions(), "glue");
   TimeStepper stepper(problem, Times(column));
   const TiedInterface &tie = *problem.Operator().Interfaces().front();
   CHECK(tie.Scales().exchanges == column.lower_permeability.has_value());
   std::vector<Row> rows;
   real_t largest_flow = 0.0;
   while (!stepper.Done())
   {
      const StepReport report = stepper.Step();
      CAPTURE(report.reason, report.time);
      REQUIRE(report.converged);
      // Iterations are those of the bodies: a linear step takes one solve for
      // each set of multipliers. Multigrid leaves something of each.
      const int of_linear = column.method == LinearMethod::direct ? 4 : 5;
      CHECK(report.solve.newton <=
            report.solves *
               (column.deformation == Deformation::finite ? 6 : of_linear));
      rows.push_back(RowOf(problem));
      const TieDiagnostics now = Diagnose(tie, stepper.State().GetBlock(0));
      CHECK(now.jumps.displacement <= tie.Scales().displacement_tolerance);
      CHECK(Length(Sum(now.source_force, 1.0, now.destination_force)) <=
            1e-10 * Length(now.source_force));
      CHECK(Length(Sum(now.source_moment, 1.0, now.destination_moment)) <=
            1e-6 * height * Length(now.source_force));
      const StageBalance &fluid = problem.Operator().Balance();
      largest_flow = std::max(largest_flow, std::abs(fluid.outflow));
      CHECK(std::abs(fluid.error) <= 1e-6 * largest_flow);
      if (!column.lower_permeability)
      {
         CHECK(now.fluid_exchange == 0.0);
      }
      else if (report.time < 500.0)
      {
         // What the lower one loses is what the upper one gets.
         CHECK(now.fluid_exchange < 0.0);
      }
   }
   return rows;
}

void Compare(const Column &column, real_t tolerance)
{
   const std::vector<Row> exact = Whole(column);
   const std::vector<Row> found = Tied(column);
   REQUIRE(found.size() == exact.size());
   real_t force = 0.0;
   real_t flow = 0.0;
   for (const Row &row : exact)
   {
      force = std::max(force, std::abs(row.reaction));
      flow = std::max(flow, std::abs(row.outflow));
   }
   for (size_t i = 0; i < exact.size(); i++)
   {
      CAPTURE(i, exact[i].reaction, found[i].reaction, exact[i].outflow,
              found[i].outflow);
      CHECK(std::abs(found[i].reaction - exact[i].reaction) <=
            tolerance * force);
      CHECK(std::abs(found[i].outflow - exact[i].outflow) <= tolerance * flow);
   }
}
} // namespace

TEST_CASE("Tied columns consolidate as one of two layers")
{
   Column column;
   column.order = GENERATE(1, 2);
   column.type = GENERATE(Element::HEXAHEDRON, Element::TETRAHEDRON);
   column.upper_permeability = GENERATE(4.0e-3, 8.0e-4);
   CAPTURE(column.order, static_cast<int>(column.type),
           column.upper_permeability);
   Compare(column, 2e-3);
}

TEST_CASE("Tied columns consolidate as one in all time schemes")
{
   Column column;
   column.scheme = GENERATE(TimeScheme::sdirk23, TimeScheme::sdirk33);
   CAPTURE(static_cast<int>(column.scheme));
   Compare(column, 2e-3);
}

TEST_CASE("Tied columns are compressed by 30 % as one of two layers")
{
   Column column;
   column.deformation = Deformation::finite;
   column.descent = 0.3 * 2.0 * height;
   column.order = GENERATE(1, 2);
   column.type = GENERATE(Element::HEXAHEDRON, Element::TETRAHEDRON);
   CAPTURE(column.order, static_cast<int>(column.type));
   Compare(column, 3e-3);
}

TEST_CASE("Nothing enters a tied half without fluid")
{
   Column column;
   column.lower_permeability.reset();
   column.deformation =
      GENERATE(Deformation::infinitesimal, Deformation::finite);
   CAPTURE(static_cast<int>(column.deformation));
   Compare(column, 2e-3);
}

TEST_CASE("The multigrid solver consolidates tied columns likewise")
{
   Column column;
   column.method = LinearMethod::block_amg;
   column.deformation =
      GENERATE(Deformation::infinitesimal, Deformation::finite);
   CAPTURE(static_cast<int>(column.deformation));
   Compare(column, 2e-3);
}
