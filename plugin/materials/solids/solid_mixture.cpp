#include "synovia/materials/solids/solid_mixture.hpp"
#include "synovia/general/error.hpp"

#include <algorithm>

namespace synovia
{

using namespace mfem;

SolidMixture::SolidMixture(std::vector<const SolidLaw *> parts_)
   : parts(std::move(parts_))
{
   if (!(AggregateModulus() > 0.0 && ShearModulus() > 0.0))
   {
      throw Error("nothing in the mixture of solids resists compression and "
                  "shear; add a ground matrix to the fibers");
   }
}

bool SolidMixture::GetStress(const MaterialPoint &point, const Tensor3<> &F,
                             Tensor3<> &stress, Tangent3 *tangent) const
{
   stress = Tensor3<>{};
   if (tangent)
   {
      *tangent = Tangent3{};
   }
   Tensor3<> part_stress;
   Tangent3 part_tangent;
   for (const SolidLaw *part : parts)
   {
      if (!part->GetStress(point, F, part_stress,
                           tangent ? &part_tangent : nullptr))
      {
         return false;
      }
      stress += part_stress;
      if (tangent)
      {
         *tangent += part_tangent;
      }
   }
   return true;
}

bool SolidMixture::IsObjective() const
{
   return std::all_of(parts.begin(), parts.end(),
                      [](const SolidLaw *part) { return part->IsObjective(); });
}

std::string SolidMixture::Validate(ElementTransformation &trans) const
{
   std::string failure;
   for (const SolidLaw *part : parts)
   {
      if (failure.empty())
      {
         failure = part->Validate(trans);
      }
   }
   return failure;
}

real_t SolidMixture::AggregateModulus() const
{
   real_t sum = 0.0;
   for (const SolidLaw *part : parts)
   {
      sum += part->AggregateModulus();
   }
   return sum;
}

real_t SolidMixture::ShearModulus() const
{
   real_t sum = 0.0;
   for (const SolidLaw *part : parts)
   {
      sum += part->ShearModulus();
   }
   return sum;
}

} // namespace synovia
