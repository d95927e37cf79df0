// ranks: 1 2 3
//
// The Jacobian of a stage with rigid bodies against central differences of its
// residual: bodies that turned far, with freedoms of all kinds, under loads
// that are dead or follow, with ligaments and a driven joint, and out of
// balance, so that all second derivatives of the rotations count.

#include "support/boxes.hpp"
#include "support/touching_blocks.hpp"
#include "synovia/fem/linear_body_form.hpp"
#include "synovia/fem/node_positions.hpp"
#include "synovia/fem/total_lagrangian_form.hpp"
#include "synovia/physics/stage_equations.hpp"

#include <catch2/catch.hpp>

using namespace mfem;
using namespace synovia;

namespace
{
/// A block between two rigid bodies.
struct Held
{
   explicit Held(Deformation deformation, bool follows)
      : mesh(MakeBox(Box())), spaces(mesh.Get(), 2),
        conditions(spaces, deformation)
   {
      const bool finite = deformation == Deformation::finite;
      materials.Set(mesh.Region("body"),
                    {finite ? static_cast<const SolidLaw *>(&solid) : &linear,
                     &fluid, 0.2});
      RigidBodyOptions top;
      top.reference = Point3{{0.4, -0.3, 1.5}};
      top.load_follows = follows;
      for (int i = 0; i < 6; i++)
      {
         top.load[i] = 0.1 * (i + 1);
         top.stiffness[i] = 0.02 * (7 - i);
      }
      conditions.AddRigidBody({"top", mesh.Boundary("z1"), top});
      RigidBodyOptions bottom;
      bottom.prescribed[1] = 0.1;
      bottom.prescribed[3] = -0.6;
      bottom.load[4] = -0.3;
      conditions.AddRigidBody({"bottom", mesh.Boundary("z0"), bottom});
      AddLigaments();
      AddJoint();
      equations = std::make_unique<StageEquations>(
         spaces, conditions, no_pairs, no_interfaces, MakeBodies(finite));

      const RigidTies &ties = equations->Ties();
      stage.dt = 2.0;
      stage.time = 1.0;
      stage.u0.SetSize(spaces.Displacement().GetTrueVSize());
      stage.u0 = 0.0;
      stage.p0.SetSize(spaces.Pressure().GetTrueVSize());
      stage.p0 = 0.0;
      stage.p = RandomEntries(stage.p0.Size(), 7);
      stage.poses = {{{0.2, -0.1, 0.3, 0.5, -0.4, 0.3}},
                     {{0.1, 0.0, -0.1, 0.0, 0.2, -0.1}},
                     {{0.3, 0.0, -0.2, 0.0, 0.5, 0.0}}};
      ties.Prescribe(stage.time, stage.poses);
      MoveBetween(ties);
      ties.Write(stage.poses, stage.u);
      equations->Bodies().GetConserved(stage.u0, stage.conserved0);
      conditions.GetLoads(stage.time, stage.momentum_load, stage.mass_load);
      equations->SetTimeStep(stage.dt);
      equations->SetDrainedDofs(Array<int>());
      equations->Bodies().StartStage(stage, stage.p, 2.0);
      equations->LinearizeBodies(stage);
      equations->LinearizeTies(stage);
   }

   /// In its toe region and beyond, taut and pushed together, between bodies
   /// and from one to space.
   void AddLigaments()
   {
      Ligament toe;
      toe.from = {"top", {{1.2, 0.1, 1.1}}};
      toe.to = {"bottom", {{-0.1, 0.3, -0.2}}};
      toe.options.strain_stiffness = 0.4;
      toe.options.toe_strain = 3.0;
      toe.options.prestrain = 0.5;
      conditions.AddLigament(toe);
      Ligament taut;
      taut.from = {"bottom", {{0.2, -0.4, 0.1}}};
      taut.to = {"", {{0.9, -1.1, 0.3}}};
      taut.options.stiffness = 0.3;
      taut.options.prestrain = 1.0;
      conditions.AddLigament(taut);
      Ligament spring;
      spring.from = {"", {{0.5, 0.4, 2.0}}};
      spring.to = {"top", {{0.7, 0.5, 1.4}}};
      spring.options.stiffness = 0.2;
      spring.options.slack_length = 2.5;
      spring.options.compression = true;
      conditions.AddLigament(spring);
   }

   void AddJoint()
   {
      Joint joint;
      joint.name = "joint";
      joint.proximal = {
         "top", {{0.2, 0.1, 0.8}}, {{1.0, 0.3, 0.0}}, {{0.0, 0.1, 1.0}}};
      joint.distal = {
         "bottom", {{0.3, 0.4, 0.1}}, {{1.0, 0.0, 0.2}}, {{0.1, 0.0, 1.0}}};
      joint.prescribed[0] = 0.7;
      joint.prescribed[2] = -0.1;
      joint.prescribed[4] = 0.2;
      conditions.AddJoint(joint);
   }

   /// Lets nodes follow both bodies, the more the nearer they are.
   void MoveBetween(const RigidTies &ties)
   {
      stage.u = RandomEntries(stage.u0.Size(), 5);
      stage.u *= 0.01;
      const Vector positions = NodePositions(spaces.Displacement());
      for (int dof = 0; dof < stage.u.Size(); dof += 3)
      {
         const Point3 place{
            {positions[dof], positions[dof + 1], positions[dof + 2]}};
         for (int b = 0; b < 2; b++)
         {
            const Point3 moved =
               ties.Frame(b, stage.poses)
                  .Displacement(Sum(place, -1.0, ties.Nodes(b).Reference()));
            const real_t share = b == 0 ? place[2] : 1.0 - place[2];
            for (int d = 0; d < 3; d++)
            {
               stage.u[dof + d] += share * moved[d];
            }
         }
      }
   }

   static BoxOptions Box()
   {
      BoxOptions box;
      box.nx = 2;
      box.nz = 3;
      return box;
   }

   std::unique_ptr<BodyForm> MakeBodies(bool finite)
   {
      if (finite)
      {
         return std::make_unique<TotalLagrangianForm>(mesh, spaces, materials,
                                                      conditions.Springs(),
                                                      conditions.Followers());
      }
      return std::make_unique<LinearBodyForm>(spaces, materials,
                                              conditions.Springs());
   }

   BlockVector Residual(const BlockVector &direction, real_t size) const
   {
      const RigidTies &ties = equations->Ties();
      ImplicitStage moved(stage);
      moved.u.Add(size, direction.GetBlock(0));
      moved.p.Add(size, direction.GetBlock(1));
      moved.poses = ties.Moved(stage.poses, size, direction.GetBlock(0));
      ties.Write(moved.poses, moved.u);
      BlockVector residual(spaces.Offsets());
      equations->ComputeResidual(moved, residual);
      return residual;
   }

   NamedMesh mesh;
   mutable BiphasicSpaces spaces;
   const NeoHookean solid{0.5, 0.2};
   const IsotropicElastic linear{0.5, 0.2};
   const ConstantPermeability fluid{4e-3};
   MaterialTable materials;
   BoundaryConditions conditions;
   const std::vector<ContactPair *> no_pairs;
   const std::vector<TiedInterface *> no_interfaces;
   std::unique_ptr<StageEquations> equations;
   ImplicitStage stage;
};
} // namespace

TEST_CASE("The Jacobian with rigid bodies is the derivative of the residual")
{
   const bool finite = GENERATE(false, true);
   const bool follows = finite ? GENERATE(false, true) : false;
   CAPTURE(finite, follows);
   const Held held(finite ? Deformation::finite : Deformation::infinitesimal,
                   follows);
   const RigidTies &ties = held.equations->Ties();
   const int slots = static_cast<int>(ties.Slots().size());
   REQUIRE(slots == 13);
   const auto states = held.equations->Ligaments().States(held.stage.poses);
   REQUIRE(states.size() == 3);
   CHECK(states[0].force > 0.05);
   CHECK(states[1].force > 0.1);
   CHECK(states[2].force < -0.02);
   const real_t step = finite ? 1e-6 : 1e-4;
   // Each freedom alone, all else, and all together.
   for (int k = 0; k < slots + 2; k++)
   {
      CAPTURE(k);
      BlockVector direction(held.spaces.Offsets());
      direction = 0.0;
      if (k >= slots)
      {
         direction += RandomEntries(direction.Size(), 3 + k);
      }
      direction.SyncToBlocks();
      Vector amounts(slots);
      amounts = k > slots ? 1.0 : 0.0;
      if (k < slots)
      {
         amounts[k] = 1.0;
      }
      direction.GetBlock(0).SetSubVector(ties.Dofs(), 0.0);
      ties.Scatter(amounts, direction.GetBlock(0));
      direction.SyncFromBlocks();
      BlockVector derivative(held.spaces.Offsets());
      held.equations->Jacobian().Mult(direction, derivative);
      BlockVector error = held.Residual(direction, -step);
      error -= held.Residual(direction, step);
      error *= 0.5 / step;
      error -= derivative;
      const real_t size = NormOf(derivative);
      CHECK(size > 1e-3);
      CHECK(NormOf(error) <= 1e-7 * size);
      Vector of_slots = ties.Gather(error.GetBlock(0));
      CHECK(of_slots.Norml2() <=
            1e-7 * ties.Gather(derivative.GetBlock(0)).Norml2());
   }
}

TEST_CASE("The Jacobian with rigid bodies is applied as it is assembled")
{
   const bool finite = GENERATE(false, true);
   CAPTURE(finite);
   const Held held(finite ? Deformation::finite : Deformation::infinitesimal,
                   finite);
   const RigidTies &ties = held.equations->Ties();
   const BiphasicJacobian &jacobian = held.equations->Jacobian();
   const Vector holding = jacobian.Holding(1e11);
   const auto assembled = jacobian.AssembleHeld(holding, 0.0);
   Vector applied(jacobian.Height());
   Vector product(jacobian.Height());
   for (int seed = 1; seed <= 3; seed++)
   {
      Vector x = RandomEntries(jacobian.Height(), seed);
      // Without contact the matrix is treated as symmetric, and the loads of
      // pressures are the transpose of a mass that knows the flow's change.
      for (int i = jacobian.Offsets()[1]; finite && i < x.Size(); i++)
      {
         x[i] = 0.0;
      }
      jacobian.Mult(x, applied);
      assembled->Mult(x, product);
      product -= applied;
      CHECK(NormOf(applied) > 1e-3);
      CHECK(NormOf(product) <= 1e-12 * NormOf(applied));
   }

   // A support is added to each freedom, and to nothing else.
   constexpr real_t support = 0.5;
   const auto supported = jacobian.AssembleHeld(holding, support);
   for (int k = 0; k < static_cast<int>(ties.Slots().size()); k++)
   {
      CAPTURE(k);
      Vector amounts(static_cast<int>(ties.Slots().size()));
      amounts = 0.0;
      amounts[k] = 1.0;
      Vector unit(jacobian.Height());
      unit = 0.0;
      ties.Scatter(amounts, unit);
      supported->Mult(unit, applied);
      assembled->Mult(unit, product);
      applied -= product;
      const Vector added = ties.Gather(applied);
      CHECK(NormOf(applied) == Approx(std::abs(added[k])));
      if (ties.IsFreedom(ties.Slots()[k]))
      {
         CHECK(added[k] > 1e-3);
      }
      else
      {
         CHECK(added[k] == 0.0);
      }
   }
}
