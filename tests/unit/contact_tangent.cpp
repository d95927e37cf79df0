// ranks: 1 2 3
// timeout: 300
//
// The Jacobian of a stage's equations against central differences of their
// residual: blocks in infinitesimal and finite deformation, partly in contact
// and partly apart, partly sealed and partly drained, slid on after the search,
// with a driven surface, supports and loads. Of contact alone as well, lest the
// bodies' share hides an error.

#include "support/touching_blocks.hpp"
#include "synovia/fem/linear_body_form.hpp"
#include "synovia/fem/total_lagrangian_form.hpp"

#include <catch2/catch.hpp>

#include <algorithm>

using namespace mfem;
using namespace synovia;

namespace
{
constexpr real_t difference_tolerance = 1e-7;

struct Setup
{
   std::string name;
   TouchingBlocksOptions blocks;
   /// Whether a force moves the upper block's top.
   bool driven = false;
   /// Whether vertices slide or stick, with friction.
   bool slides = false;
   bool sticks = false;
   real_t tolerance = difference_tolerance;
};

std::vector<Setup> Setups()
{
   std::vector<Setup> setups(9);
   setups[0].name = "infinitesimal";
   setups[1].name = "infinitesimal, searched where it is";
   setups[1].blocks.configuration = SearchConfiguration::current;
   setups[1].driven = true;
   setups[2].name = "finite";
   setups[3].name = "finite, curved";
   setups[3].blocks.curved = true;
   setups[4].name = "finite, driven";
   setups[4].driven = true;
   setups[5].name = "finite, what slides";
   setups[5].blocks.friction = {0.1, 0.3};
   setups[5].slides = true;
   setups[6].name = "finite, what sticks";
   setups[6].blocks.friction = {1e3, 0.3};
   setups[6].sticks = true;
   // Forces of all that slip.
   setups[6].tolerance = 1e-6;
   setups[7].name = "finite, what slides or sticks, curved";
   setups[7].blocks.curved = true;
   setups[7].blocks.friction = {0.6, 0.3};
   setups[7].slides = true;
   setups[7].sticks = true;
   setups[8].name = "finite, what slides, driven";
   setups[8].driven = true;
   setups[8].blocks.friction = {0.1, 0.3};
   setups[8].slides = true;
   for (std::size_t i = 2; i < setups.size(); i++)
   {
      setups[i].blocks.deformation = Deformation::finite;
   }
   return setups;
}

std::unique_ptr<BodyForm> MakeBodies(TouchingBlocks &blocks,
                                     const BoundaryConditions &conditions,
                                     Deformation deformation)
{
   if (deformation == Deformation::finite)
   {
      return std::make_unique<TotalLagrangianForm>(
         blocks.mesh, blocks.spaces, blocks.materials, conditions.Springs(),
         conditions.Followers());
   }
   return std::make_unique<LinearBodyForm>(blocks.spaces, blocks.materials,
                                           conditions.Springs());
}

/// A stage in which the upper block has slid on since the search.
class SlidBlocks
{
public:
   explicit SlidBlocks(const Setup &setup)
      : blocks(setup.blocks),
        conditions(blocks.spaces, setup.blocks.deformation)
   {
      const NamedMesh &mesh = blocks.mesh;
      for (int d = 0; d < 3; d++)
      {
         conditions.PrescribeDisplacement(mesh.Boundary("lower_z0"), d, 0.0);
      }
      conditions.PrescribePressure(mesh.Boundary("upper_x0"), 0.3);
      conditions.AddNormalTraction(mesh.Boundary("upper_y1"), -0.2);
      conditions.AddNormalFlux(mesh.Boundary("lower_x1"), 0.1);
      if (setup.driven)
      {
         conditions.DriveByForce(mesh.Boundary("upper_z1"),
                                 Vector({0.0, 0.6, -0.8}), 0.5);
      }
      const Deformation deformation = setup.blocks.deformation;
      step = deformation == Deformation::finite ? 3e-6 : 1e-4;
      pairs.push_back(blocks.pair.get());
      whole = std::make_unique<StageEquations>(
         blocks.spaces, conditions, pairs, no_interfaces,
         MakeBodies(blocks, conditions, deformation));
      apart = std::make_unique<StageEquations>(
         blocks.spaces, conditions, no_pairs, no_interfaces,
         MakeBodies(blocks, conditions, deformation));

      stage.dt = 3.0;
      stage.time = 1.0;
      stage.u0 = blocks.Displacement(0.0);
      stage.p0.SetSize(blocks.spaces.Pressure().GetTrueVSize());
      stage.p0 = 0.0;
      stage.u = stage.u0;
      stage.p = RandomEntries(stage.p0.Size(), 7);
      whole->Bodies().GetConserved(stage.u0, stage.conserved0);
      conditions.GetLoads(stage.time, stage.momentum_load, stage.mass_load);
      whole->SetTimeStep(stage.dt);
      apart->SetTimeStep(stage.dt);
      whole->SearchContact(stage);
      stage.u = blocks.Displacement(0.07);
      if (setup.blocks.configuration == SearchConfiguration::current)
      {
         CHECK(whole->SearchContact(stage));
      }
      blocks.Touch(stage.u, stage.p);
      whole->UpdateDrainedDofs(stage);
      apart->SetDrainedDofs(whole->DrainedDofs());
      for (StageEquations *equations : {whole.get(), apart.get()})
      {
         equations->Bodies().StartStage(stage, stage.p, 2.0);
         REQUIRE(equations->Bodies().Validate(stage).empty());
         equations->LinearizeBodies(stage);
         equations->LinearizeContact(stage);
      }
   }

   /// A change of the state, of displacement or pressure, that supports and
   /// drained surfaces allow.
   BlockVector Direction(int block, int seed) const
   {
      BlockVector direction(blocks.spaces.Offsets());
      direction = 0.0;
      const Vector entries =
         RandomEntries(direction.GetBlock(block).Size(), seed);
      direction.GetBlock(block) = entries;
      direction.GetBlock(0).SetSubVector(conditions.DisplacementDofs(), 0.0);
      direction.GetBlock(0).SetSubVector(whole->Rigid().Idle(), 0.0);
      direction.GetBlock(1).SetSubVector(whole->DrainedDofs(), 0.0);
      return direction;
   }

   BlockVector Derivative(const StageEquations &equations,
                          const BlockVector &direction) const
   {
      BlockVector derivative(blocks.spaces.Offsets());
      equations.Jacobian().Mult(direction, derivative);
      return derivative;
   }

   BlockVector Difference(StageEquations &equations,
                          const BlockVector &direction) const
   {
      BlockVector difference = Residual(equations, direction, -step);
      difference -= Residual(equations, direction, step);
      difference *= 0.5 / step;
      return difference;
   }

   TouchingBlocks blocks;
   std::unique_ptr<StageEquations> whole;
   /// Without contact.
   std::unique_ptr<StageEquations> apart;

private:
   BlockVector Residual(StageEquations &equations, const BlockVector &direction,
                        real_t size) const
   {
      ImplicitStage moved(stage);
      Vector du(direction.GetBlock(0));
      equations.Rigid().Distribute(du);
      moved.u.Add(size, du);
      moved.p.Add(size, direction.GetBlock(1));
      equations.EvaluateContact(moved);
      BlockVector residual(blocks.spaces.Offsets());
      equations.ComputeResidual(moved, residual);
      return residual;
   }

   BoundaryConditions conditions;
   std::vector<ContactPair *> pairs;
   const std::vector<ContactPair *> no_pairs;
   const std::vector<TiedInterface *> no_interfaces;
   ImplicitStage stage;
   /// Of differences. Infinitesimal equations are linear while nothing
   /// switches, so that a large one has less round-off and is as exact.
   real_t step;
};
} // namespace

TEST_CASE("The Jacobian of a stage is the derivative of its residual")
{
   Setup setup = GENERATE(from_range(Setups()));
   setup.blocks.order = GENERATE(1, 2);
   CAPTURE(setup.name, setup.blocks.order);
   SlidBlocks slid(setup);
   const auto [touching, sealed, covered] = slid.blocks.Counts();
   CHECK(sealed > 2);
   CHECK(touching > sealed);
   CHECK(covered > touching + 2);
   const bool finite = setup.blocks.deformation == Deformation::finite;
   const auto [sliding, sticking] = slid.blocks.Sliding();
   CAPTURE(touching, sliding, sticking);
   CHECK((sliding > 1) == setup.slides);
   CHECK((sticking > 1) == setup.sticks);
   CHECK(slid.blocks.pair->HasDrifted() == finite);
   CHECK(slid.blocks.pair->Factors().IsSymmetric() != finite);
   CHECK(slid.whole->Rigid().Any() == setup.driven);

   std::vector<BlockVector> directions;
   std::vector<BlockVector> all;
   std::vector<BlockVector> without;
   for (const int block : {0, 1})
   {
      for (const int seed : {1, 2})
      {
         directions.push_back(slid.Direction(block, 10 * block + seed));
         all.push_back(slid.Derivative(*slid.whole, directions.back()));
         without.push_back(slid.Derivative(*slid.apart, directions.back()));
      }
   }
   // Differences leave the contact evaluated elsewhere.
   for (std::size_t i = 0; i < directions.size(); i++)
   {
      BlockVector error = slid.Difference(*slid.whole, directions[i]);
      BlockVector contact_error = slid.Difference(*slid.apart, directions[i]);
      contact_error -= error;
      BlockVector contact(all[i]);
      contact -= without[i];
      contact_error += contact;
      error -= all[i];
      for (const int block : {0, 1})
      {
         CAPTURE(i, block);
         const real_t size = NormOf(all[i].GetBlock(block));
         CHECK(size > 0.0);
         CHECK(NormOf(error.GetBlock(block)) <= setup.tolerance * size);
         const real_t contact_size = NormOf(contact.GetBlock(block));
         CHECK(NormOf(contact_error.GetBlock(block)) <=
               setup.tolerance * std::max(contact_size, 1e-2 * size));
      }
   }
   // Contact is not next to nothing beside the bodies.
   BlockVector contact(all.front());
   contact -= without.front();
   CHECK(NormOf(contact.GetBlock(0)) > 0.1 * NormOf(all.front().GetBlock(0)));
}
