// ranks: 1 2
//
// A force per mass b on a confined column of height h that rests on a fixed,
// sealed base and drains through its top; with the densities of solid and
// fluid, the weight of the mixture is carried by
//
//     at rest: the fluid's pressure rho_f g (h - z), and the solid's effective
//     stress -phi (rho_s - rho_f) g (h - z), so that the top sinks by
//     phi (rho_s - rho_f) g h^2/(2 H);
//     at once: the pressure of the mixture's weight (phi rho_s +
//     (1 - phi) rho_f) g (h - z), which is in excess of the former by
//     phi (rho_s - rho_f) g (h - z).
//
// In finite deformation at rest, with the stress P(stretch) of the confined
// solid, dP/dZ = phi_0 (rho_s - rho_f) g: an elastic body without fluid
// likewise with rho_s g.

#include "support/boxes.hpp"
#include "synovia/fem/gravity_loads.hpp"
#include "synovia/fem/total_lagrangian_form.hpp"
#include "synovia/general/reduce.hpp"
#include "synovia/synovia.hpp"

#include <catch2/catch.hpp>

#include <cmath>

using namespace mfem;
using namespace synovia;

namespace
{
constexpr real_t phi = 0.3;
constexpr real_t heavy = 3.0;
constexpr real_t light = 1.0;
constexpr real_t g = 0.01;
constexpr real_t kappa = 4e-3;

real_t AggregateModulus()
{
   return 0.5 * 0.9 / (1.1 * 0.8);
}

struct Column
{
   Column(bool finite, bool wet, real_t strength, int cells = 10)
      : mesh(Make(cells)), problem(mesh, Space(finite))
   {
      Material material;
      material.solid =
         finite ? static_cast<const SolidLaw *>(&deforming) : &linear;
      material.permeability = wet ? &permeability : nullptr;
      material.solid_fraction = phi;
      material.solid_density = heavy;
      material.fluid_density = light;
      problem.SetMaterial("body", material);
      problem.SetAcceleration({{0.0, 0.0, -strength}});
      problem.PrescribeDisplacement("z0", 2, 0.0);
      for (const char *name : {"x0", "x1"})
      {
         problem.PrescribeDisplacement(name, 0, 0.0);
      }
      for (const char *name : {"y0", "y1"})
      {
         problem.PrescribeDisplacement(name, 1, 0.0);
      }
      if (wet)
      {
         problem.PrescribePressure("z1", 0.0);
      }
   }

   static NamedMesh Make(int cells)
   {
      BoxOptions box;
      box.nz = cells;
      box.size_x = box.size_y = 0.3;
      return MakeBox(box);
   }
   static SpaceOptions Space(bool finite)
   {
      SpaceOptions space;
      space.deformation =
         finite ? Deformation::finite : Deformation::infinitesimal;
      return space;
   }

   /// Largest displacement, and pressure, after one step.
   std::pair<real_t, real_t> After(real_t time)
   {
      TimeOptions times;
      times.step = times.end = time;
      TimeStepper stepper(problem, times);
      const StepReport report = stepper.Step();
      INFO(report.reason);
      REQUIRE(report.converged);
      const auto largest = [](const Vector &x) {
         return MaxOverRanks(x.Size() > 0 ? x.Normlinf() : 0.0, MPI_COMM_WORLD);
      };
      return {largest(stepper.State().GetBlock(0)),
              largest(stepper.State().GetBlock(1))};
   }

   IsotropicElastic linear{0.5, 0.1};
   NeoHookean deforming{0.5, 0.1};
   ConstantPermeability permeability{kappa};
   NamedMesh mesh;
   BiphasicProblem problem;
};
} // namespace

TEST_CASE("A column under its weight")
{
   const bool finite = GENERATE(false, true);
   CAPTURE(finite);
   // Finite deformation of small strains.
   const real_t strength = finite ? 1e-4 * g : g;
   const real_t close = finite ? 1e-5 : 1e-6;
   SECTION("at rest")
   {
      const auto [sunk, pressure] = Column(finite, true, strength).After(1e9);
      CHECK(sunk ==
            Approx(0.5 * phi * (heavy - light) * strength / AggregateModulus())
               .epsilon(close));
      CHECK(pressure == Approx(light * strength).epsilon(close));
   }
   SECTION("at once")
   {
      const auto [sunk, pressure] = Column(finite, true, strength).After(1e-3);
      CHECK(
         pressure ==
         Approx((phi * heavy + (1.0 - phi) * light) * strength).epsilon(1e-3));
      CHECK(sunk < 1e-2 * strength);
   }
   SECTION("without fluid")
   {
      const auto [sunk, pressure] = Column(finite, false, strength).After(1.0);
      CHECK(sunk ==
            Approx(0.5 * heavy * strength / AggregateModulus()).epsilon(close));
      CHECK(pressure == 0.0);
   }
}

TEST_CASE("A column that its weight compresses by a fourth")
{
   // The stress of the confined solid, mu (s - 1/s) + lambda ln s/s, is minus
   // the weight above: the stretch follows, and the height is its integral.
   const real_t strength = 0.5;
   const real_t mu = 0.5 / 2.2;
   const real_t lambda = 0.5 * 0.1 / (1.1 * 0.8);
   const auto stretch = [&](real_t stress)
   {
      real_t low = 0.2;
      real_t high = 1.0;
      for (int i = 0; i < 60; i++)
      {
         const real_t s = 0.5 * (low + high);
         const real_t value = mu * (s - 1.0 / s) + lambda * std::log(s) / s;
         (value > stress ? high : low) = s;
      }
      return low;
   };
   constexpr int cells = 2000;
   real_t height = 0.0;
   for (int i = 0; i < cells; i++)
   {
      const real_t above = 1.0 - (i + 0.5) / cells;
      height += stretch(-phi * (heavy - light) * strength * above) / cells;
   }
   REQUIRE(height < 0.8);
   // Long beside h^2/(H kappa), 500, but tolerances grow with the step.
   const auto [sunk, pressure] = Column(true, true, strength, 60).After(2e7);
   CHECK(sunk == Approx(1.0 - height).epsilon(1e-4));
   CHECK(pressure == Approx(light * strength * height).epsilon(1e-4));
}

TEST_CASE("The derivatives of weights are those of differences")
{
   NamedMesh mesh = Column::Make(4);
   BiphasicSpaces spaces(mesh.Get(), 2);
   const HolmesMowPermeability permeability(kappa, 2.0, 2.0, phi);
   const NeoHookean solid(0.5, 0.1);
   MaterialTable materials;
   Material material;
   material.solid = &solid;
   material.permeability = &permeability;
   material.solid_fraction = phi;
   material.solid_density = heavy;
   material.fluid_density = light;
   materials.Set(mesh.Region("body"), material);
   const GravityLoads gravity(spaces, materials, {{0.3, -0.2, -1.0}});
   const std::vector<SpringFoundation> springs;
   const FollowerLoads none(spaces);
   TotalLagrangianForm form(mesh, spaces, materials, springs, none,
                            ElementPoints::as_meshed, &gravity);
   BodyStage stage;
   stage.dt = 0.7;
   stage.time = 1.0;
   stage.u.SetSize(spaces.Displacement().GetTrueVSize());
   stage.p.SetSize(spaces.Pressure().GetTrueVSize());
   stage.u.Randomize(3);
   stage.u *= 0.01;
   stage.p.Randomize(4);
   stage.u0 = stage.u;
   stage.p0 = stage.p;
   form.GetConserved(stage.u, stage.conserved0);
   Vector direction(stage.u.Size());
   direction.Randomize(5);
   direction -= 0.5;
   form.Linearize(stage);
   Vector by_tangent(stage.u.Size());
   Vector mass_by_tangent(stage.p.Size());
   form.Tangent().stiffness->Mult(direction, by_tangent);
   form.Tangent().divergence->Mult(direction, mass_by_tangent);
   const real_t h = 1e-6;
   Vector momentum[2];
   Vector mass[2];
   const Vector u(stage.u);
   for (const int side : {0, 1})
   {
      stage.u = u;
      stage.u.Add(side == 0 ? -h : h, direction);
      form.Mult(stage, momentum[side], mass[side]);
   }
   momentum[1] -= momentum[0];
   momentum[1] /= 2.0 * h;
   mass[1] -= mass[0];
   mass[1] /= 2.0 * h;
   const auto distance = [](const Vector &a, const Vector &b)
   {
      Vector difference(a);
      difference -= b;
      const real_t error = InnerProduct(MPI_COMM_WORLD, difference, difference);
      return std::sqrt(error / InnerProduct(MPI_COMM_WORLD, b, b));
   };
   CHECK(distance(by_tangent, momentum[1]) < 1e-7);
   CHECK(distance(mass_by_tangent, mass[1]) < 1e-7);
}
