#pragma once

#include "synovia/materials/law_arguments.hpp"
#include "synovia/materials/law_description.hpp"
#include "synovia/materials/solid_law.hpp"

#include <vector>

namespace synovia
{

/// Solids that deform together, such as a ground matrix and its fibers: their
/// stresses add up.
class SolidMixture : public SolidLaw
{
public:
   static LawDescription Describe()
   {
      return {"mixture",
              "solids that deform together, such as a ground matrix and fibers",
              Deformation::finite,
              {},
              true};
   }

   explicit SolidMixture(const LawArguments &from) : SolidMixture(from.parts) {}
   /// Borrows the parts. Throws Error unless there is one with a modulus in
   /// compression.
   explicit SolidMixture(std::vector<const SolidLaw *> parts);

   bool GetStress(const MaterialPoint &point, const Tensor3<> &F,
                  Tensor3<> &stress, Tangent3 *tangent) const override;
   bool IsObjective() const override;
   std::string Validate(mfem::ElementTransformation &trans) const override;
   mfem::real_t AggregateModulus() const override;
   mfem::real_t ShearModulus() const override;

private:
   std::vector<const SolidLaw *> parts;
};

} // namespace synovia
