#include "synovia/fem/linear_body_form.hpp"

#include <algorithm>

namespace synovia
{

using namespace mfem;

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

void LinearBodyForm::AddMagnitudes(real_t dt, const Vector &u, const Vector &p,
                                   Vector &momentum, Vector &mass) const
{
   matrices.stiffness->AbsMult(1.0, u, 1.0, momentum);
   matrices.divergence->AbsMult(1.0, u, 1.0, mass);
   matrices.darcy->AbsMult(dt, p, 1.0, mass);
}

} // namespace synovia
