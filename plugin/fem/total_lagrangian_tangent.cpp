#include "synovia/fem/total_lagrangian_form.hpp"

namespace synovia
{

using namespace mfem;

bool TotalLagrangianForm::LinearizeElement(BodyElement &points, int number,
                                           real_t dt)
{
   points.Set(number, u, p);
   return tangent.Compute(
      points, materials.Get(spaces.GetMesh().GetAttribute(number)), dt);
}

void TotalLagrangianForm::LinearizeElement(int number, real_t dt)
{
   // Between the points of the residual, which are the ones that are verified,
   // a law may have no value.
   if (!straight_element || !LinearizeElement(*straight_element, number, dt))
   {
      LinearizeElement(element, number, dt);
   }
}

void TotalLagrangianForm::AddTangent(int number)
{
   stiffness.Add(number, tangent.stiffness);
   growth_transpose.AddTransposed(number, tangent.growth);
   tangent.flow_change += tangent.growth;
   divergence.Add(number, tangent.flow_change);
   darcy.Add(number, tangent.darcy);
}

void TotalLagrangianForm::CorrectStraightTangent()
{
   for (AssembledMatrix *matrix : Matrices())
   {
      matrix->Clear();
   }
   u = 0.0;
   p = 0.0;
   // Nothing flows at rest, but out of vessels for how long is not known.
   constexpr real_t no_time = 0.0;
   for (int e = 0; e < spaces.GetMesh().GetNE(); e++)
   {
      if (IsRigid(e))
      {
         continue;
      }
      LinearizeElement(element, e, no_time);
      AddTangent(e);
      LinearizeElement(*straight_element, e, no_time);
      for (DenseMatrix *part : {&tangent.stiffness, &tangent.growth,
                                &tangent.flow_change, &tangent.darcy})
      {
         part->Neg();
      }
      AddTangent(e);
   }
   for (AssembledMatrix *matrix : Matrices())
   {
      matrix->KeepAsConstant();
   }
}

bool TotalLagrangianForm::Damp(const BodyStage &stage, const Vector &direction)
{
   ToLocal(stage);
   return damping.Raise(u, p, ToLocal(direction));
}

bool TotalLagrangianForm::Linearize(const BodyStage &stage)
{
   ToLocal(stage);
   // The former ones go first: less memory.
   matrices.stiffness.reset();
   matrices.divergence_transpose.reset();
   matrices.divergence.reset();
   matrices.darcy.reset();
   for (AssembledMatrix *matrix : Matrices())
   {
      matrix->Clear();
   }
   damping.StartTangent();
   for (int e = 0; e < spaces.GetMesh().GetNE(); e++)
   {
      if (!IsRigid(e))
      {
         LinearizeElement(e, stage.dt);
         damping.AddTangent(e, u, p, tangent.stiffness);
         if (barrier)
         {
            barrier->Set(e, u, p);
            barrier->AddTangent(tangent.stiffness);
         }
         AddTangent(e);
      }
   }
   const FollowerLoads::State state = ToLoads(stage);
   loads.AddDerivatives(state, stiffness, growth_transpose, divergence);
   if (gravity)
   {
      gravity->AddDerivatives(state, stiffness, divergence);
   }
   matrices.darcy = darcy.Sum();
   matrices.divergence = divergence.Sum();
   matrices.divergence_transpose = growth_transpose.Sum();
   matrices.stiffness = stiffness.Sum();
   AddSprings();
   return true;
}

} // namespace synovia
