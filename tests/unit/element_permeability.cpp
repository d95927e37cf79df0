// ranks: 1 2
//
// With displacements of order 1 the permeability sees the mean volume ratio of
// its element: the same as the law where the deformation is the same
// everywhere, and open pores where an element bends whose mean is above the
// solid fraction.

#include "synovia/fem/element_permeability.hpp"
#include "support/boxes.hpp"
#include "synovia/fem/boundary_conditions.hpp"
#include "synovia/fem/total_lagrangian_form.hpp"
#include "synovia/materials/permeabilities/holmes_mow_permeability.hpp"
#include "synovia/materials/solids/neo_hookean.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <functional>

using namespace mfem;
using namespace synovia;

namespace
{
constexpr real_t solid_fraction = 0.4;

using Motion = std::function<void(const Vector &x, Vector &u)>;

void Bend(const Vector &x, Vector &u)
{
   u = 0.0;
   u[2] = -0.9 * x[0] * x[2];
}

void Flatten(const Vector &x, Vector &u)
{
   u = 0.0;
   u[2] = -0.65 * x[2];
}

void Shear(const Vector &x, Vector &u)
{
   u[0] = 0.2 * x[0] - 0.3 * x[1];
   u[1] = 0.3 * x[0] - 0.2 * x[1];
   u[2] = -0.3 * x[2] + 0.1 * x[0];
}

BoxOptions OneElementWide()
{
   BoxOptions box;
   box.nx = 1;
   box.ny = box.nz = 2;
   box.size_x = box.size_y = box.size_z = 1.0;
   return box;
}

/// A cube, one element wide, that is moved.
class MovedCube
{
public:
   MovedCube(int order, const Motion &motion)
      : mesh(MakeBox(OneElementWide())), spaces(mesh.Get(), order),
        element(spaces), permeability(spaces), u(&spaces.Displacement()),
        p(&spaces.Pressure())
   {
      VectorFunctionCoefficient moved(3, motion);
      u.ProjectCoefficient(moved);
      p = 0.0;
      REQUIRE(spaces.GetMesh().GetNE() > 0);
   }

   std::string Validate()
   {
      const BoundaryConditions conditions(spaces, Deformation::finite);
      MaterialTable materials;
      materials.Set(mesh.Region("body"), {&solid, &law, solid_fraction});
      TotalLagrangianForm form(mesh, spaces, materials, conditions.Springs(),
                               conditions.Followers());
      BodyStage stage;
      u.GetTrueDofs(stage.u);
      p.GetTrueDofs(stage.p);
      stage.u0 = stage.u;
      stage.p0 = stage.p;
      stage.dt = 1.0;
      form.GetConserved(stage.u0, stage.conserved0);
      form.StartStage(stage, stage.p, stage.dt);
      return form.Validate(stage);
   }

   const NeoHookean solid{0.5, 0.3};
   const HolmesMowPermeability law{0.4, 2.0, 2.0, solid_fraction};
   NamedMesh mesh;
   BiphasicSpaces spaces;
   BodyElement element;
   ElementPermeability permeability;
   ParGridFunction u;
   ParGridFunction p;
};

real_t LargestEntry(const Tensor3<> &A)
{
   real_t largest = 0.0;
   for (int k = 0; k < 9; k++)
   {
      largest = std::max(largest, std::abs(A[k / 3][k % 3]));
   }
   return largest;
}
} // namespace

TEST_CASE("A uniform deformation's permeability is the law's")
{
   const int order = GENERATE(1, 2);
   CAPTURE(order);
   MovedCube cube(order, Shear);
   for (int e = 0; e < cube.spaces.GetMesh().GetNE(); e++)
   {
      cube.element.Set(e, cube.u, cube.p);
      cube.permeability.Set(cube.element);
      for (int q = 0; q < cube.element.Points(); q++)
      {
         Tensor3<> seen{};
         Tensor3<> expected{};
         REQUIRE(cube.permeability.Get(cube.element, cube.law, q, seen));
         REQUIRE(cube.law.GetReferential(cube.element.Point(q),
                                         cube.element.DeformationGradient(q),
                                         expected, nullptr));
         CHECK(LargestEntry(seen - expected) < 1e-14);
      }
   }
}

TEST_CASE("Elements of order 1 that bend see the mean of their volume ratio")
{
   for (const int order : {1, 2})
   {
      CAPTURE(order);
      MovedCube cube(order, Bend);
      for (int e = 0; e < cube.spaces.GetMesh().GetNE(); e++)
      {
         cube.element.Set(e, cube.u, cube.p);
         cube.permeability.Set(cube.element);
         for (int q = 0; q < cube.element.Points(); q++)
         {
            const real_t at_point = 1.0 - 0.9 * cube.element.Position(q)[0];
            CHECK(cube.permeability.VolumeRatio(q) ==
                  Approx(order == 1 ? 0.55 : at_point).epsilon(1e-13));
         }
      }
   }
}

TEST_CASE("Pores close where the mean volume ratio is the solid fraction")
{
   CHECK(MovedCube(1, Bend).Validate() == "");
   CHECK_THAT(MovedCube(2, Bend).Validate(),
              Catch::Contains("the body has no pores left, as its solid "
                              "fraction is 0.4 at ("));
   CHECK_THAT(MovedCube(1, Flatten).Validate(),
              Catch::Contains("the body has no pores left, as its solid "
                              "fraction is 0.4 at (") &&
                 Catch::Contains("det F = 0.35, 0.35 in the mean of the "
                                 "element"));
}
