// ranks: 1 2 3
//
// The tangent of bodies in finite deformation, with springs, follower loads,
// vessels and stabilization, against central differences of the residual
// itself, for all shapes and orders of elements and both a symmetric and an
// unsymmetric law.

#include "support/boxes.hpp"
#include "synovia/fem/boundary_conditions.hpp"
#include "synovia/fem/total_lagrangian_form.hpp"
#include "synovia/materials/permeabilities/constant_permeability.hpp"
#include "synovia/materials/permeabilities/holmes_mow_permeability.hpp"
#include "synovia/materials/solids/holmes_mow.hpp"
#include "synovia/materials/solids/neo_hookean.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <memory>

using namespace mfem;
using namespace synovia;

namespace
{
constexpr real_t difference_step = 2e-6;
constexpr real_t tolerance = 1e-7;

NamedMesh MakeSkewedBox(Element::Type type)
{
   BoxOptions box;
   box.nx = box.ny = box.nz = 2;
   box.type = type;
   Mesh mesh = MakeBoxMesh(box);
   for (int i = 0; i < mesh.GetNV(); i++)
   {
      real_t *x = mesh.GetVertex(i);
      x[0] += 0.1 * x[1] * x[2];
      x[2] -= 0.1 * x[0] * x[1];
   }
   return DistributeMesh(mesh, {{"body", {1}}},
                         {{"z0", {1}}, {"y1", {4}}, {"x0", {5}}, {"z1", {6}}},
                         MPI_COMM_WORLD);
}

/// A skewed box on springs, pressed and drained through sides that deform.
class DeformedBody
{
public:
   DeformedBody(Element::Type type, int order, bool stiffening,
                bool mean_dilatation = false)
      : mesh(MakeSkewedBox(type)), spaces(mesh.Get(), order),
        conditions(spaces, Deformation::finite)
   {
      if (stiffening)
      {
         materials.Set(
            mesh.Region("body"),
            {&holmes_mow, &closing, 0.2, mean_dilatation, 0.0, 0.0, vessels});
      }
      else
      {
         materials.Set(mesh.Region("body"),
                       {&neo_hookean, &constant, 0.2, mean_dilatation});
      }
      conditions.AddSprings(mesh.Boundary("z0"), 2.0);
      conditions.AddNormalTraction(mesh.Boundary("z1"), Ramp(1.0, -0.7));
      conditions.AddNormalTraction(mesh.Boundary("x0"), 0.4);
      conditions.AddNormalFlux(mesh.Boundary("y1"), 0.3);
      conditions.AddEffectiveTraction(mesh.Boundary("y1"), 0.6);
      conditions.AddMixtureFlux(mesh.Boundary("z1"), 0.2);
      form = std::make_unique<TotalLagrangianForm>(
         mesh, spaces, materials, conditions.Springs(), conditions.Followers());

      // By 20 % to 30 % in each direction, turned, and a tenth of that at
      // random.
      VectorFunctionCoefficient deformation(3,
                                            [](const Vector &x, Vector &u)
                                            {
                                               u[0] = 0.2 * x[0] - 0.3 * x[1];
                                               u[1] = 0.3 * x[0] - 0.2 * x[1];
                                               u[2] = -0.3 * x[2] + 0.1 * x[0];
                                            });
      ParGridFunction field(&spaces.Displacement());
      field.ProjectCoefficient(deformation);
      field.GetTrueDofs(stage.u);
      stage.u += Random(stage.u.Size(), 0.02 / order);
      stage.p = Random(spaces.Pressure().GetTrueVSize(), 0.2);
      stage.u0 = stage.u;
      stage.u0 *= 0.9;
      stage.p0 = stage.p;
      stage.p0 *= 0.8;
      stage.time = 0.8;
      stage.dt = 0.3;
      form->GetConserved(stage.u0, stage.conserved0);
      const Vector rate(Random(stage.p.Size(), 1.0));
      form->StartStage(stage, rate, 0.2);
      REQUIRE(form->Validate(stage).empty());
      form->Linearize(stage);
   }

   const BodyStage &Stage() const { return stage; }

   // Between -size and size.
   Vector Random(int entries, real_t size)
   {
      Vector values(entries);
      values.Randomize(++seed + 100 * Mpi::WorldRank());
      values -= 0.5;
      values *= 2.0 * size;
      return values;
   }

   struct Equations
   {
      Vector momentum;
      Vector mass;
   };

   Equations Differences(const Vector &du, const Vector &dp) const
   {
      Equations ahead = Residual(du, dp, difference_step);
      const Equations behind = Residual(du, dp, -difference_step);
      ahead.momentum -= behind.momentum;
      ahead.momentum /= 2.0 * difference_step;
      ahead.mass -= behind.mass;
      ahead.mass /= 2.0 * difference_step;
      return ahead;
   }

   Equations Tangent(const Vector &du, const Vector &dp) const
   {
      const VolumeMatrices &matrices = form->Tangent();
      Equations change{Vector(du.Size()), Vector(dp.Size())};
      matrices.stiffness->Mult(du, change.momentum);
      matrices.divergence_transpose->Mult(-1.0, dp, 1.0, change.momentum);
      matrices.divergence->Mult(du, change.mass);
      matrices.darcy->Mult(stage.dt, dp, 1.0, change.mass);
      if (matrices.stabilization)
      {
         matrices.stabilization->Mult(1.0, dp, 1.0, change.mass);
      }
      return change;
   }

private:
   Equations Residual(const Vector &du, const Vector &dp, real_t step) const
   {
      BodyStage moved(stage);
      moved.u.Add(step, du);
      moved.p.Add(step, dp);
      Equations residual;
      form->Mult(moved, residual.momentum, residual.mass);
      return residual;
   }

   const NeoHookean neo_hookean{0.5, 0.3};
   const ConstantPermeability constant{0.4};
   const HolmesMow holmes_mow{0.5, 0.1, 0.5};
   const FluidSupply vessels{0.7, 0.4};
   const HolmesMowPermeability closing{0.4, 2.0, 2.0, 0.2};
   NamedMesh mesh;
   BiphasicSpaces spaces;
   BoundaryConditions conditions;
   MaterialTable materials;
   std::unique_ptr<TotalLagrangianForm> form;
   BodyStage stage;
   int seed = 0;
};

real_t Size(const Vector &x)
{
   return std::sqrt(InnerProduct(MPI_COMM_WORLD, x, x));
}

real_t RelativeDifference(const Vector &a, const Vector &b)
{
   Vector difference(a);
   difference -= b;
   REQUIRE(Size(b) > 0.0);
   return Size(difference) / Size(b);
}

void CheckTangent(DeformedBody &body)
{
   const Vector du = body.Random(body.Stage().u.Size(), 1.0);
   const Vector dp = body.Random(body.Stage().p.Size(), 1.0);
   Vector no_u(du);
   no_u = 0.0;
   Vector no_p(dp);
   no_p = 0.0;

   const auto by_u = body.Tangent(du, no_p);
   const auto by_u_differences = body.Differences(du, no_p);
   CHECK(RelativeDifference(by_u_differences.momentum, by_u.momentum) <
         tolerance);
   CHECK(RelativeDifference(by_u_differences.mass, by_u.mass) < tolerance);

   const auto by_p = body.Tangent(no_u, dp);
   const auto by_p_differences = body.Differences(no_u, dp);
   CHECK(RelativeDifference(by_p_differences.momentum, by_p.momentum) <
         tolerance);
   CHECK(RelativeDifference(by_p_differences.mass, by_p.mass) < tolerance);
}
} // namespace

TEST_CASE("The tangent of deformed bodies is the derivative of their residual")
{
   const auto type =
      GENERATE(Element::HEXAHEDRON, Element::TETRAHEDRON, Element::WEDGE);
   const int order = GENERATE(1, 2, 3);
   const bool stiffening = GENERATE(false, true);
   CAPTURE(static_cast<int>(type), order, stiffening);
   DeformedBody body(type, order, stiffening);
   CheckTangent(body);
}

TEST_CASE("So is that of bodies with a mean dilatation")
{
   const auto type =
      GENERATE(Element::HEXAHEDRON, Element::TETRAHEDRON, Element::WEDGE);
   const bool stiffening = GENERATE(false, true);
   CAPTURE(static_cast<int>(type), stiffening);
   DeformedBody body(type, 1, stiffening, true);
   CheckTangent(body);
}

TEST_CASE("At rest the tangent is the stiffness of infinitesimal deformation")
{
   const bool mean_dilatation = GENERATE(false, true);
   CAPTURE(mean_dilatation);
   NamedMesh mesh = MakeSkewedBox(Element::HEXAHEDRON);
   BiphasicSpaces spaces(mesh.Get(), 1);
   const BoundaryConditions conditions(spaces, Deformation::finite);
   const NeoHookean solid(0.5, 0.45);
   const ConstantPermeability permeability(0.4);
   MaterialTable materials;
   materials.Set(mesh.Region("body"),
                 {&solid, &permeability, 0.2, mean_dilatation});
   TotalLagrangianForm form(mesh, spaces, materials, conditions.Springs(),
                            conditions.Followers());
   BodyStage rest;
   rest.u.SetSize(spaces.Displacement().GetTrueVSize());
   rest.p.SetSize(spaces.Pressure().GetTrueVSize());
   rest.u = 0.0;
   rest.p = 0.0;
   rest.u0 = rest.u;
   rest.p0 = rest.p;
   rest.dt = 0.3;
   form.GetConserved(rest.u, rest.conserved0);
   Vector du(rest.u.Size());
   du.Randomize(1 + Mpi::WorldRank());
   Vector expected(du.Size());
   Vector found(du.Size());
   VolumeMatrices(spaces, materials).stiffness->Mult(du, expected);
   form.Linearize(rest);
   form.Tangent().stiffness->Mult(du, found);
   CHECK(RelativeDifference(found, expected) < 1e-13);
}
