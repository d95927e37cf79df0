#include "synovia/fem/linear_body_form.hpp"

#include <algorithm>
#include <cmath>

namespace synovia
{

using namespace mfem;

namespace
{
// What vessels let in where the pressure is 0, true dofs.
void AssembleSupply(BiphasicSpaces &spaces, const MaterialTable &materials,
                    Vector &supply)
{
   SupplyCoefficient rate(materials, [](const FluidSupply &vessels)
                          { return vessels.Rate(0.0); });
   ParLinearForm form(&spaces.Pressure());
   form.AddDomainIntegrator(new DomainLFIntegrator(rate));
   form.Assemble();
   supply.SetSize(spaces.Pressure().GetTrueVSize());
   form.ParallelAssemble(supply);
   supply.HostReadWrite();
}
} // namespace

LinearBodyForm::LinearBodyForm(BiphasicSpaces &spaces,
                               const MaterialTable &materials,
                               const std::vector<SpringFoundation> &springs)
   : matrices(spaces, materials)
{
   for (const SpringFoundation &spring : springs)
   {
      matrices.stiffness.reset(
         Add(1.0, *matrices.stiffness, 1.0, spring.Matrix()));
   }
   if (matrices.stabilization)
   {
      smooth_stabilization =
         std::make_unique<SmoothStabilization>(spaces, materials);
   }
   if (materials.HasSupply())
   {
      AssembleSupply(spaces, materials, supply);
      has_supply = true;
   }
}

void LinearBodyForm::StartStage(const BodyStage &stage,
                                const Vector &pressure_rate, real_t rate_dt)
{
   if (smooth_stabilization)
   {
      smooth_stabilization->Mult(pressure_rate, relief);
      // After a jump the rate says nothing of a longer step.
      relief *= std::min(stage.dt, rate_dt);
   }
}

void LinearBodyForm::Mult(const BodyStage &stage, Vector &momentum,
                          Vector &mass) const
{
   momentum.SetSize(stage.u.Size());
   matrices.stiffness->Mult(stage.u, momentum);
   matrices.divergence_transpose->Mult(-1.0, stage.p, 1.0, momentum);

   GetGrowth(stage, mass);
   matrices.darcy->Mult(stage.dt, stage.p, 1.0, mass);
   if (has_supply)
   {
      mass.Add(-stage.dt, supply);
   }
   if (matrices.stabilization)
   {
      Vector pressure_increment(stage.p);
      pressure_increment -= stage.p0;
      matrices.stabilization->Mult(1.0, pressure_increment, 1.0, mass);
      mass -= relief;
   }
}

void LinearBodyForm::GetGrowth(const BodyStage &stage, Vector &growth) const
{
   Vector increment(stage.u);
   increment -= stage.u0;
   growth.SetSize(stage.p.Size());
   matrices.divergence->Mult(increment, growth);
}

std::optional<real_t> LinearBodyForm::Supply(const BodyStage &stage) const
{
   if (!has_supply)
   {
      return std::nullopt;
   }
   // Flow between nodes cancels in the sum over all ranks.
   Vector held_back(supply.Size());
   matrices.darcy->Mult(stage.p, held_back);
   held_back.HostRead();
   return supply.Sum() - held_back.Sum();
}

void LinearBodyForm::AddMagnitudes(real_t dt, const Vector &u, const Vector &p,
                                   Vector &momentum, Vector &mass) const
{
   matrices.stiffness->AbsMult(1.0, u, 1.0, momentum);
   matrices.divergence_transpose->AbsMult(1.0, p, 1.0, momentum);
   matrices.divergence->AbsMult(1.0, u, 1.0, mass);
   matrices.darcy->AbsMult(dt, p, 1.0, mass);
   for (int i = 0; has_supply && i < supply.Size(); i++)
   {
      mass[i] += dt * std::abs(supply[i]);
   }
}

} // namespace synovia
