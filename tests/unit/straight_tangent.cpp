// ranks: 1 2
//
// Tangents of elements with curved sides that are integrated at the points of
// straight ones, against those with all points.

#include "support/boxes.hpp"
#include "synovia/fem/boundary_conditions.hpp"
#include "synovia/fem/total_lagrangian_form.hpp"
#include "synovia/materials/permeabilities/holmes_mow_permeability.hpp"
#include "synovia/materials/solids/holmes_mow.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <functional>

using namespace mfem;
using namespace synovia;

namespace
{
NamedMesh MakeCurvedBox()
{
   BoxOptions box;
   box.nx = box.ny = box.nz = 2;
   Mesh mesh = MakeBoxMesh(box);
   mesh.SetCurvature(2);
   mesh.Transform(
      [](const Vector &x, Vector &moved)
      {
         moved = x;
         moved[2] += 0.2 * (x[0] * x[0] + x[1] * x[1]);
      });
   return DistributeMesh(mesh, {{"body", {1}}}, {{"z0", {1}}}, MPI_COMM_WORLD);
}

class CurvedBody
{
public:
   explicit CurvedBody(ElementPoints points)
      : mesh(MakeCurvedBox()), spaces(mesh.Get(), 1),
        conditions(spaces, Deformation::finite)
   {
      materials.Set(mesh.Region("body"), {&solid, &permeability, 0.2});
      form = std::make_unique<TotalLagrangianForm>(
         mesh, spaces, materials, conditions.Springs(), conditions.Followers(),
         points);
   }

   /// Stiffness times a vector where the box is pressed by @a compression.
   Vector Force(real_t compression)
   {
      const auto project =
         [&](const std::function<void(const Vector &, Vector &)> &function)
      {
         VectorFunctionCoefficient coefficient(3, function);
         ParGridFunction field(&spaces.Displacement());
         field.ProjectCoefficient(coefficient);
         Vector values;
         field.GetTrueDofs(values);
         return values;
      };
      BodyStage stage;
      stage.u = project(
         [&](const Vector &x, Vector &u)
         {
            u = 0.0;
            u[2] = -compression * x[2];
         });
      stage.p.SetSize(spaces.Pressure().GetTrueVSize());
      stage.p = 0.0;
      stage.u0 = stage.u;
      stage.p0 = stage.p;
      stage.dt = 0.3;
      form->GetConserved(stage.u0, stage.conserved0);
      form->StartStage(stage, stage.p, 0.0);
      form->Linearize(stage);
      const Vector direction = project(
         [](const Vector &x, Vector &u)
         {
            u[0] = std::sin(3.0 * x[1]);
            u[1] = std::sin(4.0 * x[2]);
            u[2] = std::cos(5.0 * x[0] * x[2]);
         });
      Vector force(direction.Size());
      form->Tangent().stiffness->Mult(direction, force);
      return force;
   }

private:
   const HolmesMow solid{0.5, 0.1, 0.5};
   const HolmesMowPermeability permeability{0.4, 2.0, 2.0, 0.2};
   NamedMesh mesh;
   BiphasicSpaces spaces;
   BoundaryConditions conditions;
   MaterialTable materials;
   std::unique_ptr<TotalLagrangianForm> form;
};

real_t Size(const Vector &x)
{
   return std::sqrt(InnerProduct(MPI_COMM_WORLD, x, x));
}
} // namespace

TEST_CASE("Straight sides take a tangent that is exact at rest")
{
   // What straight sides lack at rest is kept in single precision.
   constexpr real_t of_single = 1e-8;
   CurvedBody exact(ElementPoints::as_meshed);
   CurvedBody fast(ElementPoints::straight);
   const auto error = [&](real_t compression)
   {
      const Vector expected = exact.Force(compression);
      REQUIRE(Size(expected) > 0.01);
      Vector difference = fast.Force(compression);
      difference -= expected;
      return Size(difference) / Size(expected);
   };
   CHECK(error(0.0) < of_single);
   // Fewer points do make a difference, and a small one.
   const real_t deformed = error(0.2);
   CHECK(deformed > 1e-6);
   CHECK(deformed < 1e-2);
   // The constant part stays as it is.
   CHECK(error(0.0) < of_single);
}
