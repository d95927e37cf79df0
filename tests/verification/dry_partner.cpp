// ranks: 1 2 3
//
// Contact with a body that has no fluid: where they touch, the biphasic side is
// sealed, or drains freely if the pair says so. Where they don't touch, it
// drains freely unless its surface is sealed.
//
// A confined biphasic column of height h, modulus H and kappa, whose base
// drains, is pressed at once by -P through an elastic block. It consolidates
// with a sealed top, or drains through both ends, which is a sealed one of half
// the height (Terzaghi): with m = (n + 1/2) pi, n >= 0, and s = H kappa t/d^2,
// d = h or h/2,
//
//    largest pressure   P sum 2 (-1)^n/m exp(-m^2 s)
//    compression        P h/H (1 - sum 2/m^2 exp(-m^2 s))
//
// A rigid plane that a force presses does the same, with the base open, or with
// the base sealed and the plane open: the fluid leaves at the rate at which the
// column is compressed. Between a sealed plane and a sealed base the fluid
// bears all of the load.

#include "support/boxes.hpp"
#include "synovia/general/reduce.hpp"
#include "synovia/mesh/boundary_marker.hpp"
#include "synovia/mesh/shape_mesh.hpp"
#include "synovia/synovia.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>

using namespace mfem;
using namespace synovia;

namespace
{
constexpr real_t kappa = 4e-3;
constexpr real_t load = 1e-5;

real_t AggregateModulus(real_t young, real_t poisson)
{
   return young * (1.0 - poisson) / ((1.0 + poisson) * (1.0 - 2.0 * poisson));
}

const real_t tissue = AggregateModulus(0.5, 0.1);
const real_t block = AggregateModulus(2.0, 0.2);

struct Series
{
   explicit Series(real_t s)
   {
      for (int n = 0; n < 200; n++)
      {
         const real_t m = (n + 0.5) * M_PI;
         const real_t left = std::exp(-m * m * s);
         pressure += (n % 2 == 0 ? 2.0 : -2.0) / m * left;
         compression -= 2.0 / (m * m) * left;
         rate += 2.0 * left;
      }
   }
   real_t pressure = 0.0;
   real_t compression = 1.0;
   /// Of the compression, d/ds.
   real_t rate = 0.0;
};

struct Columns
{
   explicit Columns(bool finite, const char *loaded = "upper_z1")
      : mesh(Make()), problem(mesh, Space(finite)),
        elastic(finite ? static_cast<const SolidLaw *>(&finite_block)
                       : &linear_block),
        solid(finite ? static_cast<const SolidLaw *>(&finite_tissue)
                     : &linear_tissue)
   {
      problem.SetMaterial("lower", *solid, permeability);
      problem.SetMaterial("upper", *elastic);
      problem.FixDisplacement("lower_z0");
      for (const std::string body : {"lower_", "upper_"})
      {
         for (const char *side : {"x0", "x1"})
         {
            problem.PrescribeDisplacement(body + side, 0, 0.0);
         }
         for (const char *side : {"y0", "y1"})
         {
            problem.PrescribeDisplacement(body + side, 1, 0.0);
         }
      }
      problem.PrescribePressure("lower_z0", 0.0);
      problem.AddNormalTraction(loaded, -load);
   }

   static NamedMesh Make()
   {
      BoxOptions lower;
      lower.nx = lower.ny = 2;
      lower.nz = 14;
      lower.size_x = lower.size_y = 0.3;
      BoxOptions upper(lower);
      upper.nx = upper.ny = 3;
      upper.nz = 2;
      upper.size_z = 0.5;
      return MakeStack(lower, upper);
   }

   static SpaceOptions Space(bool finite)
   {
      SpaceOptions space;
      space.deformation =
         finite ? Deformation::finite : Deformation::infinitesimal;
      return space;
   }

   /// How far the lower column's top has sunk.
   real_t Compression(const Vector &u)
   {
      Array<int> dofs;
      problem.Spaces().Displacement().GetEssentialTrueDofs(
         BoundaryMarker(problem.Spaces().GetMesh(), mesh.Boundary("lower_z1")),
         dofs, 2);
      real_t most = 0.0;
      for (const int dof : dofs)
      {
         most = std::max(most, std::abs(u[dof]));
      }
      return MaxOverRanks(most, MPI_COMM_WORLD);
   }

   NamedMesh mesh;
   BiphasicProblem problem;
   const IsotropicElastic linear_block{2.0, 0.2};
   const IsotropicElastic linear_tissue{0.5, 0.1};
   const NeoHookean finite_block{2.0, 0.2};
   const NeoHookean finite_tissue{0.5, 0.1};
   const ConstantPermeability permeability{kappa};
   const SolidLaw *elastic;
   const SolidLaw *solid;
};

real_t Largest(const Vector &x)
{
   return MaxOverRanks(x.Size() > 0 ? x.Normlinf() : 0.0, MPI_COMM_WORLD);
}
} // namespace

TEST_CASE("A column under an elastic block drains as its pair says")
{
   const bool finite = GENERATE(false, true);
   const bool drains = GENERATE(false, true);
   const bool block_is_source = GENERATE(true, false);
   CAPTURE(finite, drains, block_is_source);
   Columns columns(finite);
   ContactOptions contact;
   contact.dry_partner =
      drains ? DryPartner::draining : DryPartner::impermeable;
   if (block_is_source)
   {
      columns.problem.AddContact("upper_z0", "lower_z1", contact);
   }
   else
   {
      columns.problem.AddContact("lower_z1", "upper_z0", contact);
   }
   const real_t path = drains ? 0.5 : 1.0;
   const real_t unit = path * path / (tissue * kappa);
   TimeOptions times;
   times.scheme = TimeScheme::sdirk33;
   times.step = 0.02 * unit;
   times.end = 20 * times.step;
   times.cut_back = false;
   TimeStepper stepper(columns.problem, times);
   while (!stepper.Done())
   {
      const StepReport report = stepper.Step();
      INFO(report.reason);
      REQUIRE(report.converged);
      const real_t s = report.time / unit;
      CAPTURE(s);
      const ContactDiagnostics pair =
         Diagnose(*columns.problem.Operator().Pairs().front());
      CHECK(pair.fluid_exchange == 0.0);
      // What the jump of the load made has gone by then.
      if (s < 0.2)
      {
         continue;
      }
      const Series series(s);
      CHECK(Largest(stepper.State().GetBlock(1)) ==
            Approx(load * series.pressure).epsilon(3e-3));
      CHECK(Largest(stepper.State().GetBlock(0)) ==
            Approx(load * (0.5 / block + series.compression / tissue))
               .epsilon(3e-3));
      CHECK(pair.fluid_load_support ==
            Approx(drains ? 0.0 : series.pressure).margin(3e-3));
      CHECK(pair.peak_pressure ==
            Approx(drains ? 0.0 : load * series.pressure).margin(3e-3 * load));
   }
}

TEST_CASE("A surface that nothing touches drains unless it is sealed")
{
   const bool finite = GENERATE(false, true);
   const bool sealed = GENERATE(false, true);
   CAPTURE(finite, sealed);
   Columns columns(finite, "lower_z1");
   columns.problem.PrescribeDisplacement("upper_z1", 2, 0.01);
   columns.problem.AddContact("upper_z0", "lower_z1");
   if (sealed)
   {
      columns.problem.Seal("lower_z1");
   }
   const real_t path = sealed ? 1.0 : 0.5;
   const real_t unit = path * path / (tissue * kappa);
   TimeOptions times;
   times.scheme = TimeScheme::sdirk33;
   times.step = 0.02 * unit;
   times.end = 20 * times.step;
   times.cut_back = false;
   TimeStepper stepper(columns.problem, times);
   while (!stepper.Done())
   {
      const StepReport report = stepper.Step();
      INFO(report.reason);
      REQUIRE(report.converged);
      const real_t s = report.time / unit;
      CAPTURE(s);
      const ContactDiagnostics pair =
         Diagnose(*columns.problem.Operator().Pairs().front());
      CHECK(Length(pair.destination_force) == 0.0);
      if (s < 0.2)
      {
         continue;
      }
      const Series series(s);
      CHECK(Largest(stepper.State().GetBlock(1)) ==
            Approx(load * series.pressure).epsilon(3e-3));
      CHECK(columns.Compression(stepper.State().GetBlock(0)) ==
            Approx(load * series.compression / tissue).epsilon(3e-3));
   }
}

namespace
{
constexpr real_t width = 0.3;

struct PressedColumn
{
   PressedColumn(bool finite, bool plane_drains, bool base_drains)
      : mesh(Make()), problem(mesh, Columns::Space(finite)),
        solid(finite ? static_cast<const SolidLaw *>(&finite_tissue)
                     : &linear_tissue)
   {
      problem.SetMaterial("body", *solid, permeability);
      problem.FixDisplacement("z0");
      for (const char *side : {"x0", "x1"})
      {
         problem.PrescribeDisplacement(side, 0, 0.0);
      }
      for (const char *side : {"y0", "y1"})
      {
         problem.PrescribeDisplacement(side, 1, 0.0);
      }
      if (base_drains)
      {
         problem.PrescribePressure("z0", 0.0);
      }
      RigidBodyOptions options;
      options.reference = Plane().center;
      for (const int fixed : {0, 1, 3, 4, 5})
      {
         options.prescribed[fixed] = 0.0;
      }
      options.load[2] = -load * width * width;
      problem.AddRigidBody("platen", {}, options, {"platen"});
      ContactOptions contact;
      // Far below what the load does.
      contact.gap_tolerance = 1e-10;
      contact.dry_partner =
         plane_drains ? DryPartner::draining : DryPartner::impermeable;
      problem.AddContact("platen", "z1", contact);
   }

   static RigidShape Plane()
   {
      RigidShape plane;
      plane.name = "platen";
      plane.type = RigidShape::Type::plane;
      plane.center = {0.1, 0.2, 1.0};
      plane.axis = {0.0, 0.0, -1.0};
      plane.edge = 1.0;
      return plane;
   }

   static NamedMesh Make()
   {
      BoxOptions box;
      box.nx = box.ny = 2;
      box.nz = 14;
      box.size_x = box.size_y = width;
      NamedSerialMesh all = AddShapes(MakeBoxMesh(box), {{"body", {1}}},
                                      {{"z0", {1}},
                                       {"y0", {2}},
                                       {"x1", {3}},
                                       {"y1", {4}},
                                       {"x0", {5}},
                                       {"z1", {6}}},
                                      {Plane()});
      return DistributeMesh(all.mesh, all.regions, all.boundaries,
                            MPI_COMM_WORLD);
   }

   NamedMesh mesh;
   BiphasicProblem problem;
   const IsotropicElastic linear_tissue{0.5, 0.1};
   const NeoHookean finite_tissue{0.5, 0.1};
   const ConstantPermeability permeability{kappa};
   const SolidLaw *solid;
};
} // namespace

TEST_CASE("A column under a rigid plane drains as its pair says")
{
   const bool finite = GENERATE(false, true);
   const bool plane_drains = GENERATE(false, true);
   CAPTURE(finite, plane_drains);
   PressedColumn column(finite, plane_drains, !plane_drains);
   const real_t unit = 1.0 / (tissue * kappa);
   TimeOptions times;
   times.scheme = TimeScheme::sdirk33;
   times.step = 0.02 * unit;
   times.end = 20 * times.step;
   times.cut_back = false;
   TimeStepper stepper(column.problem, times);
   while (!stepper.Done())
   {
      const StepReport report = stepper.Step();
      INFO(report.reason);
      REQUIRE(report.converged);
      const real_t s = report.time / unit;
      CAPTURE(s);
      const BiphasicOperator &op = column.problem.Operator();
      const ContactDiagnostics pair = Diagnose(*op.Pairs().front());
      CHECK(pair.fluid_exchange == 0.0);
      CHECK(pair.destination_force[2] ==
            Approx(-load * width * width).epsilon(1e-6));
      if (s < 0.2)
      {
         continue;
      }
      const Series series(s);
      CHECK(Largest(stepper.State().GetBlock(1)) ==
            Approx(load * series.pressure).epsilon(3e-3));
      CHECK(Largest(stepper.State().GetBlock(0)) ==
            Approx(load * series.compression / tissue).epsilon(3e-3));
      CHECK(column.problem.RigidBodyStates().front().pose[2] ==
            Approx(-load * series.compression / tissue).epsilon(3e-3));
      CHECK(op.Balance().outflow ==
            Approx(width * width * load * series.rate / (tissue * unit))
               .epsilon(3e-3));
      CHECK(pair.fluid_load_support ==
            Approx(plane_drains ? 0.0 : series.pressure).margin(3e-3));
      CHECK(pair.peak_pressure ==
            Approx(plane_drains ? 0.0 : load * series.pressure)
               .margin(3e-3 * load));
   }
}

TEST_CASE("No fluid leaves between a sealed plane and a sealed base")
{
   const bool finite = GENERATE(false, true);
   CAPTURE(finite);
   PressedColumn column(finite, false, false);
   const real_t unit = 1.0 / (tissue * kappa);
   TimeOptions times;
   times.step = 0.1 * unit;
   times.end = 4 * times.step;
   times.cut_back = false;
   TimeStepper stepper(column.problem, times);
   while (!stepper.Done())
   {
      const StepReport report = stepper.Step();
      INFO(report.reason);
      REQUIRE(report.converged);
      const BiphasicOperator &op = column.problem.Operator();
      const ContactDiagnostics pair = Diagnose(*op.Pairs().front());
      // Of what leaves in a unit of time if one of them drains.
      const real_t drained = width * width * load / (tissue * unit);
      CHECK(std::abs(op.Balance().outflow) < 1e-6 * drained);
      CHECK(std::abs(op.Balance().growth) < 1e-6 * drained);
      CHECK(pair.fluid_load_support == Approx(1.0).epsilon(1e-5));
      CHECK(Largest(stepper.State().GetBlock(1)) == Approx(load).epsilon(1e-5));
      CHECK(Largest(stepper.State().GetBlock(0)) < 1e-5 * load / tissue);
   }
}

TEST_CASE("A side of a pair has fluid, or it has none")
{
   Columns columns(false);
   columns.problem.AddContact(std::vector<std::string>{"upper_z0", "lower_x0"},
                              std::vector<std::string>{"lower_z1"},
                              ContactOptions(), "mixed");
   CHECK_THROWS_WITH(columns.problem.Operator(),
                     Catch::Contains("contact pair \"mixed\": some of the "
                                     "regions of its source have fluid"));
}
