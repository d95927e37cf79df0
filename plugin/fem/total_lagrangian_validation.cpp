#include "synovia/fem/total_lagrangian_form.hpp"
#include "synovia/general/error.hpp"
#include "synovia/general/text.hpp"

namespace synovia
{

using namespace mfem;

std::string TotalLagrangianForm::Validate(const BodyStage &stage) const
{
   Remember(stage, balance);
   if (balance.IsFinite())
   {
      return "";
   }
   ToLocal(stage);
   std::string failure;
   for (int e = 0; e < spaces.GetMesh().GetNE() && failure.empty(); e++)
   {
      if (IsRigid(e))
      {
         continue;
      }
      element.Set(e, u, p);
      permeability.Set(element);
      for (int q = 0; q < element.Points() && failure.empty(); q++)
      {
         failure = ValidatePoint(e, q);
      }
      if (failure.empty() && barrier)
      {
         barrier->Set(e, u, p);
         failure = ValidateCorners(e);
      }
   }
   return AgreeOnText(spaces.GetComm(), failure);
}

std::string TotalLagrangianForm::ValidatePoint(int number, int point) const
{
   const Material &material = materials.Get(element.Attribute());
   const Tensor3<> F = element.DeformationGradient(point);
   const real_t J = det(F);
   Tensor3<> value;
   std::string what;
   if (!(J > 0.0))
   {
      what = "is turned inside out";
   }
   else if (material.HasFluid() &&
            !(permeability.VolumeRatio(point) > material.solid_fraction))
   {
      what = "has no pores left, as its solid fraction is " +
             ToText(material.solid_fraction);
   }
   else if (material.mean_dilatation
               ? !mean_dilatation.Evaluate(element, *material.solid)
               : !GetStress(material, point, F, value))
   {
      what = "has no finite stress";
   }
   else if (material.HasFluid() &&
            !permeability.Get(element, *material.permeability, point, value))
   {
      what = "has no permeability";
   }
   if (what.empty())
   {
      return "";
   }
   const std::string mean = permeability.HasMean() && material.HasFluid()
                               ? ", " +
                                    ToText(permeability.VolumeRatio(point)) +
                                    " in the mean of the element"
                               : "";
   return "the body " + what + Place(number, element.Position(point), J) + mean;
}

std::string TotalLagrangianForm::ValidateCorners(int number) const
{
   const auto inverted = barrier->FindInverted();
   return inverted ? "the body is turned inside out in a corner" +
                        Place(number, inverted->position, inverted->J)
                   : "";
}

std::string TotalLagrangianForm::Place(int number, const Vector &x,
                                       real_t J) const
{
   return " at (" + ToText(x[0]) + ", " + ToText(x[1]) + ", " + ToText(x[2]) +
          "), as meshed, in element " +
          std::to_string(mesh.SerialElements()[number]) + " of \"" +
          NameOf(mesh.Regions(), spaces.GetMesh().GetAttribute(number)) +
          "\": det F = " + ToText(J);
}

} // namespace synovia
