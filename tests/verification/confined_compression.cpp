// ranks: 1 2 3
//
// Confined compression of a layer between an impermeable base and a porous
// platen (Mow et al. 1980): one-dimensional consolidation with H_A and kappa.
// Sides are rollers and impermeable, so that u = u_z(z, t), p = p(z, t).

#include "support/boxes.hpp"
#include "support/reference_table.hpp"
#include "synovia/general/reduce.hpp"
#include "synovia/synovia.hpp"

#include <catch2/catch.hpp>

#include <cmath>

using namespace mfem;
using namespace synovia;

namespace
{
constexpr real_t height = 0.75;
constexpr real_t side = 0.2;

const IsotropicElastic &Cartilage()
{
   static const IsotropicElastic law(0.5417, 0.0833);
   return law;
}

const ConstantPermeability &CartilagePermeability()
{
   static const ConstantPermeability law(4.0e-3);
   return law;
}

void Confine(BiphasicProblem &problem)
{
   problem.SetMaterial("body", Cartilage(), CartilagePermeability());
   problem.FixDisplacement("z0");
   for (const char *name : {"x0", "x1"})
   {
      problem.PrescribeDisplacement(name, 0, 0.0);
   }
   for (const char *name : {"y0", "y1"})
   {
      problem.PrescribeDisplacement(name, 1, 0.0);
   }
}

BoxOptions Layer(Element::Type type)
{
   BoxOptions box;
   box.nx = 2;
   box.ny = 2;
   box.nz = 12;
   box.type = type;
   box.size_x = side;
   box.size_y = side;
   box.size_z = height;
   box.grading = 1.5;
   return box;
}
} // namespace

TEST_CASE("A ramped platen meets the exact stress within 0.1 %")
{
   const auto type = GENERATE(Element::HEXAHEDRON, Element::TETRAHEDRON);
   NamedMesh mesh = MakeBox(Layer(type));
   BiphasicProblem problem(mesh, SpaceOptions());
   Confine(problem);
   problem.PrescribePressure("z1", 0.0);
   problem.PrescribeDisplacement("z1", 2, Ramp(500.0, -0.075));
   TimeOptions options;
   options.end = 750.0;
   options.step = 12.5;
   options.scheme = TimeScheme::sdirk33;
   TimeStepper stepper(problem, options);

   const ReferenceTable reference("confined_ramp_reaction.csv");
   int compared = 0;
   while (!stepper.Done())
   {
      const StepReport report = stepper.Step();
      REQUIRE(report.converged);
      for (const real_t t : {50.0, 250.0, 500.0, 750.0})
      {
         if (std::abs(stepper.Time() - t) < 1e-9)
         {
            const real_t stress =
               -problem.Reaction(problem.Supports().back())[2] / (side * side);
            const real_t exact =
               reference.Find({{"t", t}}, "stress_compressive");
            CAPTURE(t, stress, exact);
            CHECK(stress == Approx(exact).epsilon(1e-3));
            compared++;
         }
      }
      CHECK(std::abs(problem.Operator().Balance().error) <=
            1e-6 * std::abs(problem.Operator().Balance().outflow) + 1e-14);
   }
   CHECK(compared == 4);
}

TEST_CASE("Creep under a step load meets the exact surface displacement "
          "within 0.1 %")
{
   const real_t load = 0.01;
   NamedMesh mesh = MakeBox(Layer(Element::HEXAHEDRON));
   BiphasicProblem problem(mesh, SpaceOptions());
   Confine(problem);
   problem.PrescribePressure("z1", 0.0);
   problem.AddNormalTraction("z1", -load);
   TimeOptions options;
   options.end = 500.0;
   options.step = 2.5;
   options.scheme = TimeScheme::sdirk33;
   TimeStepper stepper(problem, options);

   const ReferenceTable reference("confined_creep_profile.csv");
   const int top = problem.Spaces().GetMesh().GetNV() > 0 ? 1 : 0;
   CHECK(top == 1);
   int compared = 0;
   while (!stepper.Done())
   {
      REQUIRE(stepper.Step().converged);
      for (const real_t t : {50.0, 250.0, 500.0})
      {
         if (std::abs(stepper.Time() - t) < 1e-9)
         {
            real_t lowest = 0.0;
            const ParGridFunction &u = stepper.Displacement();
            for (int i = 2; i < u.Size(); i += 3)
            {
               lowest = std::min(lowest, u[i]);
            }
            MPI_Allreduce(MPI_IN_PLACE, &lowest, 1,
                          MPITypeMap<real_t>::mpi_type, MPI_MIN,
                          MPI_COMM_WORLD);
            const real_t exact = reference.Find({{"t", t}, {"z", height}}, "u");
            CAPTURE(t, lowest, exact);
            CHECK(lowest == Approx(exact).epsilon(1e-3));
            compared++;
         }
      }
   }
   CHECK(compared == 3);
}

TEST_CASE("A sealed column bears a load by its fluid alone")
{
   const real_t load = 0.01;
   const TimeScheme scheme =
      GENERATE(TimeScheme::backward_euler, TimeScheme::sdirk33);
   const int order = GENERATE(1, 2);
   CAPTURE(static_cast<int>(scheme), order);
   NamedMesh mesh = MakeBox(Layer(Element::HEXAHEDRON));
   SpaceOptions space;
   space.order = order;
   BiphasicProblem problem(mesh, space);
   Confine(problem);
   problem.AddNormalTraction("z1", -load);
   TimeOptions options;
   options.step = 100.0;
   options.end = 500.0;
   options.cut_back = false;
   options.scheme = scheme;
   TimeStepper stepper(problem, options);
   while (!stepper.Done())
   {
      const StepReport report = stepper.Step();
      INFO(report.reason);
      REQUIRE(report.converged);
      CHECK(report.solve.newton <= 12);
      const Vector &u = stepper.State().GetBlock(0);
      const Vector &p = stepper.State().GetBlock(1);
      const auto largest = [](const Vector &x) {
         return MaxOverRanks(x.Size() > 0 ? x.Normlinf() : 0.0, MPI_COMM_WORLD);
      };
      Vector excess(p);
      excess -= load;
      CHECK(largest(excess) < 1e-7 * load);
      CHECK(largest(u) < 1e-7 * load / Cartilage().AggregateModulus());
   }
}
