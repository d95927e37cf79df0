// ranks: 1 2
//
// Tangents of elements that a direction strains too much are damped, and no
// others.

#include "synovia/fem/element_damping.hpp"
#include "support/boxes.hpp"
#include "synovia/fem/boundary_conditions.hpp"
#include "synovia/fem/total_lagrangian_form.hpp"
#include "synovia/materials/permeabilities/constant_permeability.hpp"
#include "synovia/materials/solids/neo_hookean.hpp"

#include <catch2/catch.hpp>

#include <memory>

using namespace mfem;
using namespace synovia;

namespace
{
constexpr real_t pressure = 0.3;

/// Two unit cubes beside each other, at rest but for the pressure; directions
/// pull the far end of one of them.
class TwoCubes
{
public:
   TwoCubes()
      : mesh(MakeBox(Box())), spaces(mesh.Get(), 1),
        conditions(spaces, Deformation::finite)
   {
      materials.Set(mesh.Region("body"), {&solid, &law, 0.2});
      form = std::make_unique<TotalLagrangianForm>(
         mesh, spaces, materials, conditions.Springs(), conditions.Followers());
      stage.u.SetSize(spaces.Displacement().GetTrueVSize());
      stage.u = 0.0;
      stage.u0 = stage.u;
      stage.p.SetSize(spaces.Pressure().GetTrueVSize());
      stage.p = pressure;
      stage.p0 = stage.p;
      stage.dt = 1.0;
      form->GetConserved(stage.u0, stage.conserved0);
      Start();
   }

   void Start() { form->StartStage(stage, stage.p, stage.dt); }
   bool DampFar(real_t strain) { return form->Damp(stage, Far(strain)); }
   void Ease() { form->EaseDamping(); }

   /// Work of the tangent's forces in a direction of unit strain.
   real_t WorkFar() { return Work(Far(1.0)); }
   real_t WorkNear()
   {
      return Work(Direction([](real_t x) { return std::min(x - 1.0, 0.0); }));
   }

   /// Work of what the tangent's damping resists the same direction with.
   real_t DampingWorkFar()
   {
      const Vector direction = Far(1.0);
      Vector forces(direction.Size());
      forces = 0.0;
      form->AddDampingForces(direction, forces);
      return InnerProduct(MPI_COMM_WORLD, direction, forces);
   }

   real_t Stiffness() const { return 2.0 * solid.ShearModulus(); }

private:
   static BoxOptions Box()
   {
      BoxOptions box;
      box.nx = 2;
      box.nz = 1;
      box.size_x = 2.0;
      return box;
   }

   template <typename Profile>
   Vector Direction(const Profile &profile)
   {
      VectorFunctionCoefficient along_x(3,
                                        [profile](const Vector &x, Vector &u)
                                        {
                                           u = 0.0;
                                           u[0] = profile(x[0]);
                                        });
      ParGridFunction u(&spaces.Displacement());
      u.ProjectCoefficient(along_x);
      Vector direction;
      u.GetTrueDofs(direction);
      return direction;
   }

   Vector Far(real_t strain)
   {
      return Direction([strain](real_t x)
                       { return strain * std::max(x - 1.0, 0.0); });
   }

   real_t Work(const Vector &direction)
   {
      form->Linearize(stage);
      Vector forces(direction.Size());
      form->Tangent().stiffness->Mult(direction, forces);
      return InnerProduct(MPI_COMM_WORLD, direction, forces);
   }

   const NeoHookean solid{1.0, 0.3};
   const ConstantPermeability law{1.0};
   NamedMesh mesh;
   BiphasicSpaces spaces;
   BoundaryConditions conditions;
   MaterialTable materials;
   std::unique_ptr<TotalLagrangianForm> form;
   BodyStage stage;
};
} // namespace

TEST_CASE("Elements that a direction strains too much are damped")
{
   TwoCubes cubes;
   const real_t far = cubes.WorkFar();
   const real_t near = cubes.WorkNear();
   const real_t stress = pressure + cubes.Stiffness();

   CHECK_FALSE(cubes.DampFar(0.2));
   CHECK(cubes.WorkFar() == Approx(far));

   CHECK(cubes.DampFar(0.4));
   CHECK(cubes.WorkFar() == Approx(far + 0.25 * stress));
   CHECK(cubes.WorkNear() == Approx(near));

   CHECK(cubes.DampFar(0.4));
   CHECK(cubes.WorkFar() == Approx(far + stress));
}

TEST_CASE("The forces of damping are those in the last tangent")
{
   TwoCubes cubes;
   const real_t stress = pressure + cubes.Stiffness();
   cubes.WorkFar();
   CHECK(cubes.DampingWorkFar() == 0.0);

   REQUIRE(cubes.DampFar(0.4));
   CHECK(cubes.DampingWorkFar() == 0.0);
   cubes.WorkFar();
   CHECK(cubes.DampingWorkFar() == Approx(0.25 * stress));

   cubes.Ease();
   CHECK(cubes.DampingWorkFar() == Approx(0.25 * stress));
   cubes.WorkFar();
   CHECK(cubes.DampingWorkFar() == Approx(0.125 * stress));
}

TEST_CASE("Damping ends in steps, and with its stage")
{
   TwoCubes cubes;
   const real_t far = cubes.WorkFar();
   const real_t stress = pressure + cubes.Stiffness();
   REQUIRE(cubes.DampFar(0.4));
   cubes.Ease();
   CHECK(cubes.WorkFar() == Approx(far + 0.125 * stress));
   cubes.Ease();
   CHECK(cubes.WorkFar() == Approx(far));

   REQUIRE(cubes.DampFar(0.4));
   cubes.Start();
   CHECK(cubes.WorkFar() == Approx(far));
}

TEST_CASE("Damping has an end")
{
   TwoCubes cubes;
   int raised = 0;
   while (cubes.DampFar(0.4) && raised < 100)
   {
      raised++;
   }
   CHECK(raised > 1);
   CHECK(raised < 10);
}
