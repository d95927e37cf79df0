// ranks: 1 2 3
// timeout: 300
//
// Contact of bodies that deform by 30 %: columns on columns, of the same laws
// and of others, meshes that don't match, loaded blocks that turn by 90
// degrees, and blocks that slide.

#include "support/boxes.hpp"
#include "support/newton_iterates.hpp"
#include "support/reference_table.hpp"
#include "synovia/contact/contact_diagnostics.hpp"
#include "synovia/general/reduce.hpp"
#include "synovia/materials/permeabilities/constant_permeability.hpp"
#include "synovia/materials/permeabilities/holmes_mow_permeability.hpp"
#include "synovia/materials/solids/holmes_mow.hpp"
#include "synovia/materials/solids/neo_hookean.hpp"
#include "synovia/synovia.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

using namespace mfem;
using namespace synovia;

namespace
{
// Thousands of gel times.
constexpr real_t long_time = 1.0e9;

SpaceOptions Finite(int order)
{
   SpaceOptions space;
   space.order = order;
   space.deformation = Deformation::finite;
   return space;
}

NonlinearOptions Exact()
{
   NonlinearOptions nonlinear;
   nonlinear.linear.method = LinearMethod::direct;
   nonlinear.linear.relative_tolerance = 1e-12;
   return nonlinear;
}

ContactOptions Closed()
{
   ContactOptions contact;
   contact.gap_tolerance = 1e-11;
   contact.pressure_tolerance = 1e-9;
   return contact;
}

void HoldSides(BiphasicProblem &problem)
{
   for (const std::string body : {"lower_", "upper_"})
   {
      problem.PrescribeDisplacement(body + "x0", 0, 0.0);
      problem.PrescribeDisplacement(body + "x1", 0, 0.0);
      problem.PrescribeDisplacement(body + "y0", 1, 0.0);
      problem.PrescribeDisplacement(body + "y1", 1, 0.0);
   }
   problem.PrescribeDisplacement("lower_z0", 2, 0.0);
}

struct Spread
{
   real_t least = infinity();
   real_t most = -infinity();

   void Add(real_t value)
   {
      least = std::min(least, value);
      most = std::max(most, value);
   }
   void ShareOverRanks(MPI_Comm comm)
   {
      least = -MaxOverRanks(-least, comm);
      most = MaxOverRanks(most, comm);
   }
};

// Of a field's component at the vertices at a height, on both sides of contact.
Spread SpreadAt(const ParMesh &mesh, const ParGridFunction &field, int width,
                int component, real_t height)
{
   Spread spread;
   for (int i = 0; i < mesh.GetNV(); i++)
   {
      real_t x[3];
      const_cast<ParMesh &>(mesh).GetNode(i, x);
      if (std::abs(x[2] - height) < 1e-9)
      {
         spread.Add(field[width * i + component]);
      }
   }
   spread.ShareOverRanks(mesh.GetComm());
   return spread;
}

StepReport MustStep(TimeStepper &stepper)
{
   const StepReport report = stepper.Step();
   INFO(report.reason);
   REQUIRE(report.converged);
   return report;
}

// Of a pair's vertices that touch, nominal.
Spread Tractions(const ContactPair &pair, MPI_Comm comm)
{
   Spread spread;
   const ContactState &state = pair.State();
   for (int j = 0; j < state.traction.Size(); j++)
   {
      if (state.vertices[j].touches)
      {
         spread.Add(state.traction[j]);
      }
   }
   spread.ShareOverRanks(comm);
   return spread;
}
} // namespace

TEST_CASE("Two columns in contact are one column, compressed by 30 %")
{
   const bool stiffening = GENERATE(false, true);
   CAPTURE(stiffening);
   BoxOptions lower;
   lower.nz = 16;
   lower.size_x = lower.size_y = 0.1;
   lower.size_z = 0.5;
   BoxOptions upper = lower;
   upper.nx = 2;
   NamedMesh mesh = MakeStack(lower, upper);
   const NeoHookean neo_hookean(0.5, 0.1);
   const ConstantPermeability constant(4.0e-3);
   const HolmesMow holmes_mow(0.5, 0.1, 0.5);
   const HolmesMowPermeability closing(4.0e-3, 2.0, 2.0, 0.2);
   BiphasicProblem problem(mesh, Finite(2));
   for (const char *body : {"lower", "upper"})
   {
      if (stiffening)
      {
         problem.SetMaterial(body, holmes_mow, closing);
      }
      else
      {
         problem.SetMaterial(body, neo_hookean, constant);
      }
   }
   HoldSides(problem);
   problem.PrescribeDisplacement("upper_z1", 2, Ramp(500.0, -0.3));
   problem.PrescribePressure("upper_z1", 0.0);
   ContactOptions contact;
   contact.gap_tolerance = 1e-6;
   contact.pressure_tolerance = 1e-4;
   problem.AddContact("upper_z0", "lower_z1", contact);
   TimeOptions times;
   times.end = 500.0;
   times.step = 25.0;
   times.scheme = TimeScheme::sdirk33;
   TimeStepper stepper(problem, times);
   const ReferenceTable reference(
      stiffening ? "finite_confined_holmesmow.csv"
                 : "finite_confined_neohookean_constant.csv");
   const real_t peak = reference.Find({{"t", 500.0}}, "p_base");
   int compared = 0;
   while (!stepper.Done())
   {
      const StepReport report = MustStep(stepper);
      CHECK(report.solve.newton <=
            8 * (1 + report.solve.augmentations) * report.solves);
      const real_t t = stepper.Time();
      if (std::abs(t - 250.0) > 1e-9 && std::abs(t - 500.0) > 1e-9)
      {
         continue;
      }
      CAPTURE(t);
      constexpr real_t tolerance = 2e-3;
      const real_t stress =
         problem.Reaction(problem.Supports().back())[2] / 0.01;
      const real_t middle =
         SpreadAt(mesh.Get(), stepper.Displacement(), 3, 2, 0.5).most;
      const real_t base =
         SpreadAt(mesh.Get(), stepper.Pressure(), 1, 0, 0).most;
      CHECK(stress ==
            Approx(reference.Find({{"t", t}}, "stress")).epsilon(tolerance));
      CHECK(middle ==
            Approx(reference.Find({{"t", t}}, "u_mid")).epsilon(tolerance));
      CHECK(base == Approx(reference.Find({{"t", t}}, "p_base"))
                       .epsilon(0.0)
                       .margin(tolerance * peak));
      compared++;
   }
   CHECK(compared == 2);
}

namespace
{
// Two columns of other laws, or one column of two layers, 1 high.
struct Layers
{
   const NeoHookean lower_solid{0.5, 0.1};
   const ConstantPermeability lower_fluid{4.0e-3};
   const HolmesMow upper_solid{0.8, 0.2, 0.5};
   const HolmesMowPermeability upper_fluid{2.0e-3, 2.0, 2.0, 0.2};

   void SetTo(BiphasicProblem &problem) const
   {
      problem.SetMaterial("lower", lower_solid, lower_fluid);
      problem.SetMaterial("upper", upper_solid, upper_fluid);
   }
};

// The end of a step: the stress of the top, and what is between the layers.
struct Moment
{
   real_t time;
   real_t stress;
   Spread displacement;
   Spread pressure;
};

// Compresses by 30 % within 500 s, and holds for 100 s: each 50 s of that.
// Steps grow from where the load begins and ends.
std::vector<Moment> Compress(NamedMesh &mesh, BiphasicProblem &problem,
                             const std::string &top, real_t step)
{
   problem.PrescribeDisplacement(top, 2, Ramp(500.0, -0.3));
   problem.PrescribePressure(top, 0.0);
   TimeOptions times;
   times.end = 600.0;
   times.step = step;
   times.growth = 1.3;
   times.max_step = 6.25 * step;
   times.scheme = TimeScheme::sdirk33;
   constexpr real_t interval = 50.0;
   for (real_t t = interval; t < times.end; t += interval)
   {
      times.stops.push_back(t);
   }
   TimeStepper stepper(problem, times);
   std::vector<Moment> moments;
   while (!stepper.Done())
   {
      MustStep(stepper);
      if (std::abs(std::remainder(stepper.Time(), interval)) > 1e-9)
      {
         continue;
      }
      moments.push_back(
         {stepper.Time(), problem.Reaction(problem.Supports().back())[2] / 0.01,
          SpreadAt(mesh.Get(), stepper.Displacement(), 3, 2, 0.5),
          SpreadAt(mesh.Get(), stepper.Pressure(), 1, 0, 0.5)});
   }
   return moments;
}

// The layers share the nodes between them.
std::vector<Moment> CompressLayers(const Layers &layers)
{
   BoxOptions box;
   box.nz = 64;
   box.size_x = box.size_y = 0.1;
   Mesh serial = MakeBoxMesh(box);
   for (int i = 0; i < serial.GetNE(); i++)
   {
      Vector center(3);
      serial.GetElementCenter(i, center);
      serial.SetAttribute(i, center[2] < 0.5 ? 1 : 2);
   }
   serial.SetAttributes();
   NamedMesh mesh = DistributeMesh(
      serial, {{"lower", {1}}, {"upper", {2}}},
      {{"z0", {1}}, {"y", {2, 4}}, {"x", {3, 5}}, {"z1", {6}}}, MPI_COMM_WORLD);
   BiphasicProblem problem(mesh, Finite(2));
   layers.SetTo(problem);
   problem.PrescribeDisplacement("x", 0, 0.0);
   problem.PrescribeDisplacement("y", 1, 0.0);
   problem.PrescribeDisplacement("z0", 2, 0.0);
   return Compress(mesh, problem, "z1", 2.0);
}

std::vector<Moment> CompressColumns(const Layers &layers, bool from_above)
{
   BoxOptions lower;
   lower.nz = 16;
   lower.size_x = lower.size_y = 0.1;
   lower.size_z = 0.5;
   BoxOptions upper = lower;
   upper.nx = 2;
   upper.nz = 20;
   NamedMesh mesh = MakeStack(lower, upper);
   BiphasicProblem problem(mesh, Finite(2));
   layers.SetTo(problem);
   HoldSides(problem);
   ContactOptions contact;
   contact.gap_tolerance = 1e-6;
   contact.pressure_tolerance = 1e-4;
   problem.AddContact(from_above ? "upper_z0" : "lower_z1",
                      from_above ? "lower_z1" : "upper_z0", contact);
   return Compress(mesh, problem, "upper_z1", 4.0);
}
} // namespace

// Both programs of the references have one law for a whole column, so that the
// column of two layers is this program's, with a finer mesh and shorter steps.
TEST_CASE("Two columns of different laws in contact are one column of two "
          "layers, compressed by 30 %")
{
   const Layers layers;
   const std::vector<Moment> expected = CompressLayers(layers);
   real_t peak = 0.0;
   for (const Moment &moment : expected)
   {
      peak = std::max(peak, moment.pressure.most);
   }
   // There is much of everything.
   CHECK(peak > 0.05);
   CHECK(expected.back().displacement.most < -0.12);
   for (const bool from_above : {false, true})
   {
      const std::vector<Moment> found = CompressColumns(layers, from_above);
      REQUIRE(found.size() == 12);
      REQUIRE(expected.size() == found.size());
      constexpr real_t tolerance = 2e-3;
      for (std::size_t i = 0; i < found.size(); i++)
      {
         const Moment &wanted = expected[i];
         CAPTURE(from_above, wanted.time);
         REQUIRE(found[i].time == Approx(wanted.time));
         CHECK(found[i].stress == Approx(wanted.stress).epsilon(tolerance));
         for (const real_t u :
              {found[i].displacement.least, found[i].displacement.most})
         {
            CHECK(u == Approx(wanted.displacement.most).epsilon(tolerance));
         }
         for (const real_t p :
              {found[i].pressure.least, found[i].pressure.most})
         {
            CHECK(p == Approx(wanted.pressure.most)
                          .epsilon(0.0)
                          .margin(tolerance * peak));
         }
      }
   }
}

// Held at the sides and drained, lower and upper block are in uniform stress:
//
//     P = mu (s - 1/s) + lambda log(s) / s,    h_1 s_1 + h_2 s_2 = h - delta
TEST_CASE("Meshes that don't match pass the patch test at 30 % compression")
{
   const auto type = GENERATE(Element::HEXAHEDRON, Element::TETRAHEDRON);
   const int order = GENERATE(1, 2);
   CAPTURE(static_cast<int>(type), order);
   BoxOptions lower;
   lower.nx = 2;
   lower.ny = 2;
   lower.nz = 2;
   lower.type = type;
   lower.size_z = 0.6;
   BoxOptions upper = lower;
   upper.nx = 3;
   upper.ny = 3;
   upper.size_z = 0.5;
   NamedMesh mesh = MakeStack(lower, upper);
   const std::array<real_t, 2> young{{0.5, 0.9}};
   const std::array<real_t, 2> poisson{{0.3, 0.2}};
   const std::array<real_t, 2> heights{{lower.size_z, upper.size_z}};
   const NeoHookean lower_solid(young[0], poisson[0]);
   const NeoHookean upper_solid(young[1], poisson[1]);
   const ConstantPermeability fluid(4.0e-3);
   BiphasicProblem problem(mesh, Finite(order));
   problem.SetMaterial("lower", lower_solid, fluid);
   problem.SetMaterial("upper", upper_solid, fluid);
   HoldSides(problem);
   const real_t descent = 0.3 * (heights[0] + heights[1]);
   problem.PrescribeDisplacement("upper_z1", 2, Ramp(long_time, -descent));
   problem.PrescribePressure("lower_z0", 0.0);
   problem.PrescribePressure("upper_z1", 0.0);
   problem.AddContact("upper_z0", "lower_z1", Closed());
   problem.SetNonlinearOptions(Exact());
   TimeOptions times;
   times.end = long_time;
   times.step = long_time / 4.0;
   TimeStepper stepper(problem, times);
   while (!stepper.Done())
   {
      MustStep(stepper);
   }

   const auto stress = [&](int body, real_t stretch)
   {
      const LameModuli moduli(young[body], poisson[body]);
      return moduli.mu * (stretch - 1.0 / stretch) +
             moduli.lambda * std::log(stretch) / stretch;
   };
   real_t low = 0.3;
   real_t high = 1.0;
   real_t other = 1.0;
   for (int i = 0; i < 60; i++)
   {
      const real_t s = 0.5 * (low + high);
      other = (heights[0] + heights[1] - descent - heights[0] * s) / heights[1];
      (stress(0, s) < stress(1, other) ? low : high) = s;
   }
   const ContactPair &pair = *problem.Operator().Pairs().front();
   const Spread tractions = Tractions(pair, mesh.GetComm());
   constexpr real_t solved = 1e-7;
   CHECK(tractions.least == Approx(stress(1, other)).epsilon(solved));
   CHECK(tractions.most == Approx(stress(1, other)).epsilon(solved));
   const real_t reaction = problem.Reaction(problem.Supports().back())[2];
   CHECK(reaction == Approx(stress(1, other)).epsilon(solved));
   const ContactDiagnostics forces = Diagnose(pair);
   CHECK(forces.area == Approx(1.0).epsilon(1e-9));
   CHECK(forces.source_force[2] ==
         Approx(-forces.destination_force[2]).epsilon(1e-12));
}

namespace
{
// Turned about the y axis by an angle that grows with time, after the body was
// pressed together along z.
class Turned : public VectorCoefficient
{
public:
   Turned() : VectorCoefficient(3) {}
   void Eval(Vector &u, ElementTransformation &trans,
             const IntegrationPoint &ip) override
   {
      Vector x(3);
      trans.Transform(ip, x);
      const real_t pressed = std::min<real_t>(GetTime() / press_time, 1.0);
      const real_t angle =
         0.5 * M_PI *
         std::max<real_t>(0.0, GetTime() / press_time - turn_start) / turns;
      const real_t z = x[2] * (1.0 - 0.3 * pressed);
      u.SetSize(3);
      u[0] = std::cos(angle) * x[0] + std::sin(angle) * z - x[0];
      u[1] = 0.0;
      u[2] = -std::sin(angle) * x[0] + std::cos(angle) * z - x[2];
   }

   static constexpr real_t press_time = long_time;
   // Times press_time: when all is at rest, and what faces bear, too.
   static constexpr real_t turn_start = 2.6;
   // Times press_time: how long a quarter of a turn takes.
   static constexpr real_t turns = 2.0;
};
} // namespace

TEST_CASE("Loaded blocks in contact may be turned by 90 degrees")
{
   BoxOptions lower;
   lower.nx = 3;
   lower.ny = 2;
   lower.nz = 2;
   lower.size_y = 0.7;
   lower.size_z = 0.5;
   BoxOptions upper = lower;
   upper.nx = 2;
   upper.ny = 1;
   upper.size_x = 0.8;
   NamedMesh mesh = MakeStack(lower, upper);
   const NeoHookean lower_solid(0.5, 0.3);
   const HolmesMow upper_solid(0.7, 0.1, 0.5);
   const HolmesMowPermeability fluid(4.0e-3, 2.0, 2.0, 0.2);
   BiphasicProblem problem(mesh, Finite(2));
   problem.SetMaterial("lower", lower_solid, fluid);
   problem.SetMaterial("upper", upper_solid, fluid);
   Turned turned;
   Array<int> held(mesh.Boundary("lower_z0"));
   held.Append(mesh.Boundary("upper_z1"));
   problem.Conditions().PrescribeDisplacement(held, turned);
   problem.PrescribePressure("lower_z0", 0.0);
   problem.PrescribePressure("upper_z1", 0.02);
   problem.AddContact("lower_z1", "upper_z0", Closed());
   problem.SetNonlinearOptions(Exact());
   TimeOptions times;
   times.end = (Turned::turn_start + Turned::turns) * Turned::press_time;
   times.step = Turned::press_time / 5.0;
   TimeStepper stepper(problem, times);
   const ContactPair &pair = *problem.Operator().Pairs().front();
   Vector tractions;
   Vector pressures;
   const auto compare = [&](const Vector &now, const Vector &before)
   {
      Vector change(now);
      change -= before;
      const real_t size =
         GlobalLpNorm(infinity(), before.Normlinf(), mesh.GetComm());
      CHECK(size > 0.0);
      CHECK(GlobalLpNorm(infinity(), change.Normlinf(), mesh.GetComm()) <=
            1e-8 * size);
   };
   while (!stepper.Done())
   {
      MustStep(stepper);
      const real_t t = stepper.Time() / Turned::press_time;
      if (std::abs(t - Turned::turn_start) < 1e-9)
      {
         tractions = pair.State().traction;
         pressures = stepper.State().GetBlock(1);
      }
   }
   compare(pair.State().traction, tractions);
   compare(stepper.State().GetBlock(1), pressures);
   const ContactDiagnostics forces = Diagnose(pair);
   real_t moment = 0.0;
   for (int d = 0; d < 3; d++)
   {
      moment = std::max(moment, std::abs(forces.source_moment[d] +
                                         forces.destination_moment[d]));
      CHECK(std::abs(forces.source_force[d] + forces.destination_force[d]) <=
            1e-12 * std::abs(forces.source_force[0]));
   }
   // What pressed along z now presses along x.
   CHECK(std::abs(forces.source_force[0]) > 0.05);
   CHECK(moment <= 1e-12);
}

namespace
{
// A block with a round underside, turned against the edges of the faces below
// it, that is pressed into a block and moved on while fluid flows.
struct SlidingBlocks
{
   explicit SlidingBlocks(int max_newton)
      : mesh(MakeMesh()), problem(mesh, Finite(2))
   {
      problem.SetMaterial("lower", lower_solid, fluid);
      problem.SetMaterial("upper", upper_solid, fluid);
      problem.FixDisplacement("lower_z0");
      problem.PrescribeDisplacement(
         "upper_z1", 0, LoadCurve({0.0, 100.0, 200.0}, {0, 0, 0.1}));
      problem.PrescribeDisplacement("upper_z1", 1, 0.0);
      problem.PrescribeDisplacement("upper_z1", 2, Ramp(100.0, -0.1));
      problem.PrescribePressure("lower_z0", 0.0);
      problem.PrescribePressure("upper_z1", 0.0);
      // What is left of gaps and jumps is for Newton's method to close.
      ContactOptions contact;
      contact.gap_tolerance = 1.0;
      contact.pressure_tolerance = 1.0;
      problem.AddContact("lower_z1", "upper_z0", contact);
      problem.SetNonlinearOptions(PlainNewton(max_newton));
   }

   static NamedMesh MakeMesh()
   {
      BoxOptions lower;
      lower.nx = 3;
      lower.ny = 2;
      lower.nz = 1;
      lower.size_y = 0.8;
      lower.size_z = 0.5;
      BoxOptions upper = lower;
      upper.nx = 2;
      upper.ny = 2;
      upper.size_x = 0.7;
      upper.size_y = 0.6;
      Mesh serial = MakeStackMesh(lower, upper);
      serial.SetCurvature(2);
      serial.Transform(
         [=](const Vector &x, Vector &y)
         {
            y = x;
            y[2] += 0.2 * x[0] * x[0] + 0.1 * x[0] * x[1];
         });
      return DistributeStack(serial, MPI_COMM_WORLD);
   }

   const NeoHookean lower_solid{0.5, 0.3};
   const NeoHookean upper_solid{1.0, 0.3};
   const HolmesMowPermeability fluid{4.0e-3, 2.0, 2.0, 0.2};
   NamedMesh mesh;
   BiphasicProblem problem;
};
} // namespace

TEST_CASE("Newton's method converges quadratically where surfaces slide")
{
   TimeOptions times;
   times.end = 150.0;
   times.step = 50.0;
   const NewtonErrors errors =
      FindNewtonErrors([](int max_newton)
                       { return std::make_unique<SlidingBlocks>(max_newton); },
                       times, 50.0);
   CAPTURE(errors.u, errors.p);
   CHECK(errors.u.front() > 0.05);
   CHECK(errors.u.size() <= 1 + 6);
   CHECK(GrowthOfDigits(errors.u) >= 1.8);
   CHECK(GrowthOfDigits(errors.p) >= 1.8);
}
