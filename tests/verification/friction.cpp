// ranks: 1 2
// timeout: 600
//
// Coulomb's friction between drained blocks in finite deformation: an elastic
// block sticks below the angle of friction and slides above it, a block that
// is moved to and fro gives back what friction does not take, what a round one
// gives without being paid for vanishes with smaller elements and steps, and a
// loaded pair that turns as a whole keeps its tractions.

#include "support/boxes.hpp"
#include "synovia/contact/contact_diagnostics.hpp"
#include "synovia/contact/contact_friction.hpp"
#include "synovia/general/reduce.hpp"
#include "synovia/materials/permeabilities/constant_permeability.hpp"
#include "synovia/materials/solids/neo_hookean.hpp"
#include "synovia/synovia.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>

using namespace mfem;
using namespace synovia;

namespace
{
constexpr int most_iterations = 9;
// Of a step; thousands of gel times.
constexpr real_t long_time = 1.0e9;
constexpr real_t mu = 0.3;
constexpr real_t layer_modulus = 0.5;
constexpr real_t block_modulus = 5.0;
constexpr real_t poisson = 0.3;

struct BlocksOptions
{
   /// Times as many elements each way.
   int refinement = 1;
   /// Curvature of the block's bottom, a cylinder across the slide.
   real_t curvature = 0.0;
};

/// A layer that is held at its bottom, and a block on it, in plane strain.
class Blocks
{
public:
   explicit Blocks(const BlocksOptions &options = BlocksOptions())
      : mesh(Mesh(options)), problem(mesh, Space())
   {
      problem.SetMaterial("lower", layer, fluid);
      problem.SetMaterial("upper", block, fluid);
      for (const std::string body : {"lower_", "upper_"})
      {
         problem.PrescribeDisplacement(body + "y0", 1, 0.0);
         problem.PrescribeDisplacement(body + "y1", 1, 0.0);
      }
      problem.FixDisplacement("lower_z0");
      problem.PrescribePressure("lower_z0", 0.0);
      problem.PrescribePressure("upper_z1", 0.0);
      ContactOptions contact;
      contact.friction = {mu, 1.0};
      problem.AddContact("upper_z0", "lower_z1", contact);
   }

   const ContactPair &Pair() { return *problem.Operator().Pairs().front(); }
   FrictionDiagnostics Friction() { return Diagnose(Pair()).friction; }
   /// One step, of at most so many iterations.
   void Step(TimeStepper &stepper)
   {
      const StepReport report = stepper.Step();
      CAPTURE(report.reason, report.time / long_time, report.solve.newton);
      REQUIRE(report.converged);
      CHECK(report.failures == 0);
      CHECK(report.solve.newton <= most_iterations);
      const real_t now = Friction().dissipation;
      CHECK(now >= dissipation);
      dissipation = now;
   }

private:
   static NamedMesh Mesh(const BlocksOptions &options)
   {
      BoxOptions lower;
      lower.nx = 8 * options.refinement;
      lower.nz = 2 * options.refinement;
      lower.size_x = 1.6;
      lower.size_y = 0.2;
      lower.size_z = 0.3;
      BoxOptions upper = lower;
      upper.nx = 5 * options.refinement;
      upper.nz = options.refinement;
      upper.size_x = 0.8;
      upper.size_z = 0.15;
      mfem::Mesh mesh = MakeStackMesh(lower, upper);
      for (int i = MakeBoxMesh(lower).GetNV(); i < mesh.GetNV(); i++)
      {
         real_t *vertex = mesh.GetVertex(i);
         const real_t x = vertex[0] - 0.5 * upper.size_x;
         const real_t height = (vertex[2] - lower.size_z) / upper.size_z;
         vertex[2] += 0.5 * options.curvature * x * x * (1.0 - height);
         vertex[0] += 0.33;
      }
      return DistributeStack(mesh, MPI_COMM_WORLD);
   }
   static SpaceOptions Space()
   {
      SpaceOptions space;
      space.deformation = Deformation::finite;
      return space;
   }

   NamedMesh mesh;
   NeoHookean layer{layer_modulus, poisson};
   NeoHookean block{block_modulus, poisson};
   ConstantPermeability fluid{4.0e-3};

public:
   BiphasicProblem problem;

private:
   real_t dissipation = 0.0;
};
} // namespace

TEST_CASE("An elastic block sticks below the angle of friction")
{
   constexpr real_t area = 0.8 * 0.2;
   constexpr real_t pressed = 0.02;
   constexpr real_t stiffness = 3e-3;
   Blocks blocks;
   BiphasicProblem &problem = blocks.problem;
   problem.AddTraction("upper_z1", Vector({0.0, 0.0, -1.0}),
                       LoadCurve({0.0, 2.0 * long_time}, {0.0, pressed}));
   // What the bodies' weight does on an incline that gets steeper: the tangent
   // of its angle, over mu.
   const std::vector<real_t> slopes{0.0,  0.0, 0.0,  0.1,  0.2,  0.3,
                                    0.4,  0.5, 0.6,  0.7,  0.8,  0.9,
                                    0.95, 1.0, 1.01, 1.02, 1.03, 1.04};
   std::vector<real_t> at;
   std::vector<real_t> pulls;
   for (const real_t slope : slopes)
   {
      at.push_back(static_cast<real_t>(at.size()) * long_time);
      pulls.push_back(slope * mu * pressed);
   }
   problem.AddTraction("upper_z1", Vector({1.0, 0.0, 0.0}),
                       LoadCurve(at, pulls));
   // A spring ends the slide.
   problem.AddSprings({"upper_z1"}, stiffness, Vector({1.0, 0.0, 0.0}));
   TimeOptions times;
   times.end = at.back();
   times.step = long_time;
   TimeStepper stepper(problem, times);
   const real_t limit = mu * pressed * area;
   // Of the block, for a slope of 1, if nothing slips (length).
   real_t elastic = 0.0;
   int stuck = 0;
   int slid = 0;
   while (!stepper.Done())
   {
      blocks.Step(stepper);
      const real_t slope = slopes[stepper.Steps()];
      const Point3 spring =
         problem.Conditions().Springs()[0].Force(stepper.State().GetBlock(0));
      const FrictionDiagnostics friction = blocks.Friction();
      const real_t held = friction.force[0] / limit;
      // The layer gives way under the block, and is not quite flat: pressure
      // pushes the block along by 0.013 of the limit.
      const real_t on_layer =
         Diagnose(blocks.Pair()).destination_force[0] / limit;
      const real_t sprung = -spring[0] / limit;
      const real_t moved = -spring[0] / stiffness;
      CAPTURE(slope, sprung, held, on_layer, moved / elastic, friction.sliding);
      CHECK(on_layer + sprung == Approx(slope).epsilon(1e-6).margin(1e-9));
      CHECK(held <= 1.0);
      if (slope > 0.05 && slope < 0.55)
      {
         CHECK(friction.sliding == 0.0);
         elastic = moved / slope;
         stuck++;
      }
      else if (slope > 0.55 && slope < 1.005)
      {
         // At 1 the spring has 0.027 of it: contact holds a slope of 0.97. The
         // rim slides, and the block as far as that makes it softer.
         CHECK(friction.sliding < 0.8);
         CHECK(moved <= 1.05 * elastic * slope);
         CHECK(sprung <= 0.03);
         stuck++;
      }
      else if (slope > 1.025)
      {
         // With that share of the spring, contact would have to hold a slope
         // of 1.00.
         CHECK(friction.sliding == 1.0);
         CHECK(held == Approx(1.0).epsilon(2e-3));
         CHECK(moved > 1.5 * elastic * slope);
         slid++;
      }
   }
   CHECK(stuck == 11);
   CHECK(slid == 2);
}

namespace
{
/// The integral of the bodies' stored energy, at the points at which forces are
/// integrated, of which it is the potential.
real_t StoredEnergy(const ParGridFunction &u)
{
   ParMesh &mesh = *u.ParFESpace()->GetParMesh();
   real_t energy = 0.0;
   DenseMatrix F(3);
   for (int e = 0; e < mesh.GetNE(); e++)
   {
      const bool upper = mesh.GetAttribute(e) == 2;
      const real_t young = upper ? block_modulus : layer_modulus;
      const real_t shear = 0.5 * young / (1.0 + poisson);
      const real_t lambda = 2.0 * shear * poisson / (1.0 - 2.0 * poisson);
      ElementTransformation &trans = *mesh.GetElementTransformation(e);
      const IntegrationRule &rule = IntRules.Get(Geometry::CUBE, 4);
      for (int q = 0; q < rule.GetNPoints(); q++)
      {
         trans.SetIntPoint(&rule.IntPoint(q));
         u.GetVectorGradient(trans, F);
         for (int d = 0; d < 3; d++)
         {
            F(d, d) += 1.0;
         }
         const real_t volume = std::log(F.Det());
         const real_t stretches = F.FNorm2() - 3.0;
         energy += rule.IntPoint(q).weight * trans.Weight() *
                   (shear * (0.5 * stretches - volume) +
                    0.5 * lambda * volume * volume);
      }
   }
   return SumOverRanks(energy, mesh.GetComm());
}

/// Nodal forces of a pair's normal tractions on the bodies.
Vector NormalForces(BiphasicProblem &problem)
{
   const ContactPair &pair = *problem.Operator().Pairs().front();
   Vector forces(problem.Spaces().Displacement().GetTrueVSize());
   Vector flows(problem.Spaces().Pressure().GetTrueVSize());
   Vector rubbing(forces.Size());
   forces = 0.0;
   flows = 0.0;
   rubbing = 0.0;
   pair.AddForces(forces, flows);
   pair.Enforcement().Friction()->AddForces(
      pair.State().friction, pair.Constraint().Coverage().area, rubbing);
   forces -= rubbing;
   return forces;
}

/// A block that is moved at its top, and what becomes of the work.
class MovedBlocks
{
public:
   /// All since the run began, but for the force.
   struct Account
   {
      real_t time = 0.0;
      Point3 force{{0.0, 0.0, 0.0}};
      /// Of what moves the block, and of the normal tractions on the bodies.
      real_t work = 0.0;
      real_t normal_work = 0.0;
      real_t stored = 0.0;
      real_t dissipated = 0.0;
      /// Part of the area in contact.
      real_t sliding = 0.0;

      /// What bodies didn't give back.
      real_t Lost() const { return work - stored; }
   };

   MovedBlocks(const LoadCurve &along_, const LoadCurve &up_,
               const BlocksOptions &options = BlocksOptions())
      : blocks(options), along(along_), up(up_), stepper(MakeStepper()),
        displacement(Space().GetTrueVSize()), normal_forces(displacement.Size())
   {
      displacement = 0.0;
      normal_forces = 0.0;
   }

   bool Done() const { return stepper.Done(); }
   /// Work by the trapezoidal rule.
   Account Step()
   {
      blocks.Step(stepper);
      Account now;
      now.time = stepper.Time();
      now.force = blocks.problem.Reaction(blocks.problem.Supports().back());
      now.stored = StoredEnergy(stepper.Displacement());
      const FrictionDiagnostics friction = blocks.Friction();
      now.dissipated = friction.dissipation;
      now.sliding = friction.sliding;
      const Point3 motion{{along(now.time) - along(last.time), 0.0,
                           up(now.time) - up(last.time)}};
      now.work = last.work + 0.5 * Dot(Sum(last.force, 1.0, now.force), motion);
      Vector u;
      stepper.Displacement().GetTrueDofs(u);
      Vector moved(u);
      moved -= displacement;
      const Vector forces = NormalForces(blocks.problem);
      const real_t work = 0.5 * ((normal_forces * moved) + (forces * moved));
      now.normal_work =
         last.normal_work + SumOverRanks(work, Space().GetComm());
      displacement = u;
      normal_forces = forces;
      last = now;
      return now;
   }

private:
   ParFiniteElementSpace &Space()
   {
      return blocks.problem.Spaces().Displacement();
   }
   TimeStepper MakeStepper()
   {
      BiphasicProblem &problem = blocks.problem;
      problem.PrescribeDisplacement("upper_z1", 0, along);
      problem.PrescribeDisplacement("upper_z1", 1, 0.0);
      problem.PrescribeDisplacement("upper_z1", 2, up);
      TimeOptions times;
      times.end = up.Corners().back();
      times.step = long_time;
      return TimeStepper(problem, times);
   }

   Blocks blocks;
   LoadCurve along;
   LoadCurve up;
   TimeStepper stepper;
   Account last;
   Vector displacement;
   Vector normal_forces;
};
} // namespace

TEST_CASE("What is moved to and fro gives back what friction does not take")
{
   // Pressed, moved out, back and forth, and lifted: in no step the bodies give
   // more than they have stored, nor friction takes what isn't paid for.
   constexpr int steps = 16;
   constexpr int lifting = 8;
   constexpr real_t depth = 0.02;
   constexpr real_t way = 0.02;
   const real_t begin = 2.0 * long_time;
   const real_t quarter = steps * long_time;
   const real_t lift = begin + 5.0 * quarter;
   const real_t apart = lift + lifting * long_time;
   MovedBlocks blocks(
      LoadCurve({0.0, begin, begin + quarter, begin + 3.0 * quarter, lift},
                {0.0, 0.0, way, -way, way}),
      LoadCurve({0.0, begin, lift, apart, apart + long_time},
                {0.0, -depth, -depth, 0.0, 0.1 * depth}));
   MovedBlocks::Account before;
   MovedBlocks::Account turned;
   MovedBlocks::Account back_again;
   real_t most_stored = 0.0;
   real_t least_sliding = 1.0;
   while (!blocks.Done())
   {
      const MovedBlocks::Account now = blocks.Step();
      most_stored = std::max(most_stored, now.stored);
      const real_t lost = now.Lost() - before.Lost();
      const real_t taken = now.dissipated - before.dissipated;
      const real_t by_pressure = now.normal_work - before.normal_work;
      CAPTURE((now.time - begin) / long_time, lost, taken, by_pressure,
              now.sliding);
      // Up to the error of the trapezoidal rule.
      CHECK(lost >= -2e-4 * most_stored);
      // Pressure gives and takes by the place: points slide along the source,
      // but are pushed along normals of the destination, which may be why.
      // Under the sharp edges of the block it does however small the elements
      // are. In this slide pressure gives up to 3 % of what friction
      // takes where all slides; over a way of 0.2 on average 2.8, 2.1 and 2.4 %
      // either way, with elements of 0.2, 0.1 and 0.05, four fifths of it next
      // to the edges. Nothing else does.
      const real_t slide =
         mu * Length({{0.0, 0.0, now.force[2]}}) * way / steps;
      CHECK(lost >= taken - 0.03 * slide - 2e-4 * most_stored);
      CHECK(lost + by_pressure >= taken - 0.005 * slide - 2e-4 * most_stored);
      if (std::abs(now.time - begin - quarter) < 0.5 * long_time)
      {
         turned = now;
      }
      if (std::abs(now.time - lift) < 0.5 * long_time)
      {
         back_again = now;
         CHECK(now.sliding == 1.0);
      }
      if (now.time > begin + quarter && now.time < lift)
      {
         least_sliding = std::min(least_sliding, now.sliding);
      }
      before = now;
   }
   CHECK(least_sliding < 0.5);
   // From the first turning point to where it comes by again what the place
   // gives it takes.
   const real_t taken = back_again.dissipated - turned.dissipated;
   const real_t lost = back_again.Lost() - turned.Lost();
   CHECK(std::abs(back_again.stored - turned.stored) <= 0.01 * taken);
   CHECK(lost == Approx(taken).epsilon(5e-3));
   // Lifted, bodies have nothing left.
   CHECK(before.stored <= 1e-9 * most_stored);
   CHECK(before.work >= before.dissipated);
}

TEST_CASE("A round block that slides gives nothing away")
{
   // Contact that ends within the faces. With elements and steps of half the
   // size pressure gives a third as much, 2.9, 0.9 and 0.3 % of what friction
   // takes, and in no step friction takes more than is paid for.
   constexpr int pressing = 4;
   constexpr real_t depth = 0.02;
   constexpr real_t way = 0.1;
   const real_t begin = pressing * long_time;
   std::vector<real_t> by_pressure;
   for (const int refinement : {1, 2})
   {
      BlocksOptions options;
      options.refinement = refinement;
      options.curvature = 0.5;
      const int steps = 10 * refinement;
      const real_t end = begin + steps * long_time;
      MovedBlocks blocks(LoadCurve({0.0, begin, end}, {0.0, 0.0, way}),
                         LoadCurve({0.0, begin, end}, {0.0, -depth, -depth}),
                         options);
      by_pressure.push_back(0.0);
      MovedBlocks::Account before;
      while (!blocks.Done())
      {
         const MovedBlocks::Account now = blocks.Step();
         if (now.time > begin + 0.5 * long_time)
         {
            const real_t slide = mu * std::abs(now.force[2]) * way / steps;
            const real_t lost = (now.Lost() - before.Lost()) / slide;
            const real_t taken = (now.dissipated - before.dissipated) / slide;
            const real_t given = (now.normal_work - before.normal_work) / slide;
            // Where sliding begins within a step, the trapezoidal rule takes
            // forces for smaller than they are, by as much as they grow.
            const bool begins = before.sliding < 1.0;
            const real_t tolerance =
               begins ? 0.1 / refinement : 0.05 / (refinement * refinement);
            CAPTURE(refinement, (now.time - begin) / long_time, lost, taken,
                    given, now.sliding);
            CHECK(lost >= taken - tolerance);
            by_pressure.back() = std::max(by_pressure.back(), std::abs(given));
         }
         before = now;
      }
      CHECK(before.sliding == 1.0);
   }
   CHECK(by_pressure[0] < 0.035);
   CHECK(by_pressure[1] < 0.35 * by_pressure[0]);
}

namespace
{
/// Pressed and sheared, then turned about an axis.
class Sheared : public VectorCoefficient
{
public:
   explicit Sheared(int axis_) : VectorCoefficient(3), axis(axis_) {}
   void Eval(Vector &u, ElementTransformation &trans,
             const IntegrationPoint &ip) override
   {
      Vector x(3);
      trans.Transform(ip, x);
      const real_t t = GetTime() / long_time;
      const real_t pressed = std::min<real_t>(t / 2.0, 1.0);
      const real_t sheared =
         std::min<real_t>(std::max<real_t>(t - 2.0, 0.0) / 2.0, 1.0);
      Vector y(x);
      if (x[2] > 0.1)
      {
         y[2] -= 0.03 * pressed;
         y[0] += 0.02 * sheared;
      }
      const real_t angle = 0.5 * M_PI * std::max<real_t>(0.0, t - 4.0) / 8.0;
      const int i = (axis + 1) % 3;
      const int k = (axis + 2) % 3;
      u.SetSize(3);
      u[axis] = y[axis] - x[axis];
      u[i] = std::cos(angle) * y[i] - std::sin(angle) * y[k] - x[i];
      u[k] = std::sin(angle) * y[i] + std::cos(angle) * y[k] - x[k];
   }

private:
   int axis;
};
} // namespace

TEST_CASE("A pair that turns as a whole keeps its friction")
{
   const int axis = GENERATE(0, 1, 2);
   CAPTURE(axis);
   BoxOptions lower;
   lower.nx = 3;
   lower.ny = 2;
   lower.nz = 1;
   lower.size_x = 1.2;
   lower.size_z = 0.4;
   BoxOptions upper = lower;
   upper.nx = 2;
   upper.ny = 1;
   upper.size_x = 0.8;
   upper.size_y = 0.7;
   NamedMesh mesh = MakeStack(lower, upper);
   const NeoHookean lower_solid(0.5, 0.3);
   const NeoHookean upper_solid(0.7, 0.1);
   const ConstantPermeability fluid(4.0e-3);
   SpaceOptions space;
   space.deformation = Deformation::finite;
   BiphasicProblem problem(mesh, space);
   problem.SetMaterial("lower", lower_solid, fluid);
   problem.SetMaterial("upper", upper_solid, fluid);
   Sheared sheared(axis);
   Array<int> held(mesh.Boundary("lower_z0"));
   held.Append(mesh.Boundary("upper_z1"));
   problem.Conditions().PrescribeDisplacement(held, sheared);
   problem.PrescribePressure("lower_z0", 0.0);
   problem.PrescribePressure("upper_z1", 0.01);
   ContactOptions contact;
   contact.friction = {mu, 1.0};
   problem.AddContact("upper_z0", "lower_z1", contact);
   NonlinearOptions nonlinear;
   nonlinear.linear.method = LinearMethod::direct;
   problem.SetNonlinearOptions(nonlinear);
   TimeOptions times;
   times.end = 12.0 * long_time;
   times.step = 0.5 * long_time;
   TimeStepper stepper(problem, times);
   ContactDiagnostics before;
   while (!stepper.Done())
   {
      const StepReport report = stepper.Step();
      CAPTURE(report.reason, report.time / long_time, report.solve.newton);
      REQUIRE(report.converged);
      CHECK(report.failures == 0);
      CHECK(report.solve.newton <= most_iterations);
      if (std::abs(stepper.Time() / long_time - 4.0) < 1e-6)
      {
         before = Diagnose(*problem.Operator().Pairs().front());
      }
   }
   const ContactDiagnostics after =
      Diagnose(*problem.Operator().Pairs().front());
   const int i = (axis + 1) % 3;
   const int k = (axis + 2) % 3;
   const auto compare = [&](const Point3 &now, const Point3 &then)
   {
      // What turns about the normal slips a little where it slid before: its
      // tractions turn with the normal, and only that.
      const real_t tolerance = (axis == 2 ? 1e-3 : 1e-4) * Length(then);
      CHECK(std::abs(now[axis] - then[axis]) <= tolerance);
      CHECK(std::abs(now[i] + then[k]) <= tolerance);
      CHECK(std::abs(now[k] - then[i]) <= tolerance);
   };
   CHECK(Length(before.friction.force) > 0.05 * Length(before.source_force));
   compare(after.source_force, before.source_force);
   compare(after.friction.force, before.friction.force);
   CHECK(after.friction.dissipation ==
         Approx(before.friction.dissipation).epsilon(axis == 2 ? 1e-2 : 1e-4));
   CHECK(Length(Sum(after.source_force, 1.0, after.destination_force)) <=
         1e-12 * Length(after.source_force));
}
