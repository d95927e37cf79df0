#include "synovia/physics/stage_equations.hpp"
#include "synovia/general/reduce.hpp"
#include "synovia/physics/find_tie_holds.hpp"

#include <algorithm>

namespace synovia
{

using namespace mfem;

namespace
{
Array<int> United(const Array<int> &a, const Array<int> &b)
{
   Array<int> all(a);
   all.Append(b);
   all.Sort();
   all.Unique();
   return all;
}
} // namespace

StageEquations::StageEquations(BiphasicSpaces &spaces,
                               const BoundaryConditions &conditions_,
                               const std::vector<ContactPair *> &pairs_,
                               const std::vector<TiedInterface *> &interfaces_,
                               std::unique_ptr<BodyForm> bodies_)
   : comm(spaces.GetComm()), conditions(conditions_), pairs(pairs_),
     interfaces(interfaces_), bodies(std::move(bodies_)),
     ties(spaces, conditions.RigidBodies(), conditions.DisplacementDofs(),
          conditions.GetDeformation(), conditions.Joints()),
     ligaments(ties, conditions.Ligaments()), joints(ties, conditions.Joints()),
     rigid(spaces, conditions.DrivenSurfaces(),
           United(conditions.DisplacementDofs(), ties.Dofs())),
     tie_tangent(ties, ligaments, joints),
     drainage(spaces, pairs, conditions.Sealed()),
     contact(pairs.size() + 3 * interfaces.size()),
     jacobian(std::make_unique<BiphasicJacobian>(
        bodies->Tangent(), spaces.Offsets(), conditions.DisplacementDofs(),
        contact, rigid.Any() ? &rigid : nullptr,
        ties.Any() ? &tie_tangent : nullptr))
{
   ScaleDrives();
   const Array<int> held = spaces.VerticesAmong(conditions.PressureDofs());
   for (ContactPair *pair : pairs)
   {
      pair->Enforcement().SetHeldPressures(held);
   }
   std::vector<const TiedInterface *> searched;
   for (TiedInterface *tie : interfaces)
   {
      tie->Search(FindTieHolds(spaces, conditions, ties, pairs, searched));
      searched.push_back(tie);
   }
}

void StageEquations::ScaleDrives()
{
   if (ties.Joints() == 0)
   {
      return;
   }
   // How the bodies' matrices resist translations of all that is tied, the rest
   // being held: any number of about that size will do.
   real_t stiffness = 0.0;
   for (int d = 0; d < 3; d++)
   {
      Vector motion(bodies->Tangent().stiffness->Width());
      motion = 0.0;
      for (const int dof : ties.Dofs())
      {
         motion[dof] = dof % 3 == d ? 1.0 : 0.0;
      }
      Vector forces(motion.Size());
      bodies->Tangent().stiffness->Mult(motion, forces);
      stiffness = std::max(stiffness, InnerProduct(comm, motion, forces));
   }
   ties.ScaleDrives(stiffness > 0.0 ? stiffness : 1.0);
}

void StageEquations::SetTimeStep(real_t dt)
{
   jacobian->SetTimeStep(dt);
   for (ContactPair *pair : pairs)
   {
      pair->Enforcement().SetTimeStep(dt);
   }
   for (TiedInterface *tie : interfaces)
   {
      tie->SetTimeStep(dt);
   }
}

bool StageEquations::SearchContact(const BodyStage &stage)
{
   bool moved = !has_factors && !interfaces.empty();
   for (ContactPair *pair : pairs)
   {
      moved = pair->Search(stage.u) || moved;
   }
   if (moved)
   {
      UpdateFactors();
   }
   return moved;
}

void StageEquations::EvaluateContact(const BodyStage &stage)
{
   for (ContactPair *pair : pairs)
   {
      pair->Enforcement().Evaluate(stage.u, stage.p);
      pair->Enforcement().UpdateTractions();
   }
   for (TiedInterface *tie : interfaces)
   {
      tie->Evaluate(stage.u, stage.p);
      tie->UpdateTractions();
   }
}

void StageEquations::UpdateDrainedDofs(BodyStage &stage)
{
   const Array<int> &prescribed = conditions.PressureDofs();
   Array<int> drained(prescribed);
   for (const int dof : drainage.OpenDofs())
   {
      if (prescribed.FindSorted(dof) < 0)
      {
         drained.Append(dof);
         stage.p[dof] = 0.0;
      }
   }
   drained.Sort();
   jacobian->SetPressureDofs(drained);
   // Drained pressures changed the pressure jumps.
   EvaluateContact(stage);
}

void StageEquations::SetDrainedDofs(const Array<int> &dofs)
{
   jacobian->SetPressureDofs(dofs);
}

const Array<int> &StageEquations::DrainedDofs() const
{
   return jacobian->PressureDofs();
}

void StageEquations::ComputeBodyImbalance(const ImplicitStage &stage,
                                          Vector &momentum, Vector &mass) const
{
   if (stage.from_start)
   {
      bodies->MultFromStart(stage, momentum, mass);
   }
   else
   {
      bodies->Mult(stage, momentum, mass);
   }
   momentum -= stage.momentum_load;
   mass.Add(-stage.dt, stage.mass_load);
}

void StageEquations::AddContactForces(Vector &forces, Vector &exchange) const
{
   for (const ContactPair *pair : pairs)
   {
      pair->AddForces(forces, exchange);
   }
   for (const TiedInterface *tie : interfaces)
   {
      tie->AddForces(forces, exchange);
   }
}

void StageEquations::AddContactImbalance(const ImplicitStage &stage,
                                         Vector &momentum, Vector &mass) const
{
   Vector forces(stage.u.Size());
   Vector exchange(stage.p.Size());
   forces = 0.0;
   exchange = 0.0;
   AddContactForces(forces, exchange);
   momentum -= forces;
   mass.Add(stage.dt, exchange);
   // Sums over supports and drained surfaces are taken on the host.
   momentum.HostReadWrite();
   mass.HostReadWrite();
}

void StageEquations::ComputeImbalance(const ImplicitStage &stage,
                                      Vector &momentum, Vector &mass) const
{
   ComputeBodyImbalance(stage, momentum, mass);
   AddContactImbalance(stage, momentum, mass);
}

void StageEquations::MakeResidual(const ImplicitStage &stage,
                                  BlockVector &imbalance) const
{
   imbalance.GetBlock(0).Neg();
   imbalance.GetBlock(0).SetSubVector(conditions.DisplacementDofs(), 0.0);
   rigid.Collect(imbalance.GetBlock(0));
   rigid.AddForces(stage.time, imbalance.GetBlock(0));
   if (ties.Any())
   {
      std::vector<TiedForces> sums =
         SumForces(ties, stage.poses, imbalance.GetBlock(0));
      ligaments.AddForces(stage.poses, sums);
      imbalance.GetBlock(0).SetSubVector(ties.Dofs(), 0.0);
      Vector forces = FreedomForces(ties, stage.poses, stage.time, sums);
      joints.AddForces(stage.poses, stage.time, forces);
      ties.Scatter(forces, imbalance.GetBlock(0));
   }
   imbalance.GetBlock(1).SetSubVector(DrainedDofs(), 0.0);
   imbalance.SyncFromBlocks();
}

void StageEquations::ComputeResidual(const ImplicitStage &stage,
                                     BlockVector &residual) const
{
   ComputeImbalance(stage, residual.GetBlock(0), residual.GetBlock(1));
   MakeResidual(stage, residual);
}

StageBalance StageEquations::Balance(const ImplicitStage &stage) const
{
   StageBalance balance;
   Vector mass;
   ComputeImbalance(stage, balance.support, mass);
   balance.loads = stage.momentum_load;
   bodies->AddLoads(stage, balance.loads);
   Vector exchange(stage.p.Size());
   exchange = 0.0;
   AddContactForces(balance.loads, exchange);
   Vector growth;
   bodies->GetGrowth(stage, growth);
   real_t drained = 0.0;
   for (const int dof : DrainedDofs())
   {
      drained += mass[dof];
   }
   const real_t sources =
      SumOverRanks(stage.mass_load.Sum() + bodies->Inflow(stage), comm);
   balance.growth = SumOverRanks(growth.Sum(), comm) / stage.dt;
   balance.outflow = -SumOverRanks(drained, comm) / stage.dt - sources;
   balance.supply = bodies->Supply(stage);
   if (balance.supply)
   {
      balance.supply = SumOverRanks(*balance.supply, comm);
   }
   balance.error =
      balance.growth + balance.outflow - balance.supply.value_or(0.0);
   return balance;
}

bool StageEquations::LinearizeBodies(const BodyStage &stage)
{
   const bool changed = bodies->Linearize(stage);
   if (changed)
   {
      jacobian->BodiesChanged();
   }
   return changed;
}

bool StageEquations::LinearizeContact(const BodyStage &stage)
{
   for (ContactPair *pair : pairs)
   {
      pair->StartLinearize(stage.p);
   }
   for (ContactPair *pair : pairs)
   {
      pair->IntegrateDerivatives();
   }
   bool changed = false;
   for (ContactPair *pair : pairs)
   {
      changed = pair->FinishLinearize(stage.p) || changed;
   }
   if (changed)
   {
      UpdateFactors();
   }
   return changed;
}

void StageEquations::LinearizeTies(const ImplicitStage &stage)
{
   if (!ties.Any())
   {
      return;
   }
   Vector momentum(stage.u.Size());
   momentum = 0.0;
   if (ties.IsFinite())
   {
      Vector mass;
      ComputeImbalance(stage, momentum, mass);
      momentum.Neg();
   }
   tie_tangent.Linearize(stage.poses, stage.time, momentum);
   resisting = ligaments.Resisting(stage.poses);
}

void StageEquations::Add(real_t share, const BlockVector &step,
                         ImplicitStage &stage) const
{
   stage.u.Add(share, step.GetBlock(0));
   stage.p.Add(share, step.GetBlock(1));
   if (ties.Any())
   {
      stage.poses = ties.Moved(stage.poses, share, step.GetBlock(0));
      ties.Write(stage.poses, stage.u);
   }
}

Vector StageEquations::DisplacementIn(const BlockVector &step) const
{
   Vector displacement(step.GetBlock(0));
   if (ties.Any())
   {
      tie_tangent.Move(ties.Gather(step.GetBlock(0)), displacement);
   }
   return displacement;
}

void StageEquations::UpdateFactors()
{
   for (std::size_t i = 0; i < pairs.size(); i++)
   {
      contact[i] = pairs[i]->Factors();
   }
   std::size_t next = pairs.size();
   for (const TiedInterface *tie : interfaces)
   {
      for (const ContactFactors &component : tie->Factors())
      {
         contact[next++] = component;
      }
   }
   has_factors = true;
   jacobian->ContactChanged();
}

} // namespace synovia
