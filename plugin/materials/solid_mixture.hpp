#pragma once

#include "synovia/materials/hyperelastic_law.hpp"

#include <vector>

namespace synovia
{

/// Solids that deform together, such as a ground matrix and its fibers: their
/// stresses add up.
class SolidMixture : public HyperelasticLaw
{
public:
   /// Borrows the parts. Throws Error unless there is one with a modulus in
   /// compression.
   explicit SolidMixture(std::vector<const HyperelasticLaw *> parts);

   bool GetStress(const MaterialPoint &point, const Tensor3<> &F,
                  Tensor3<> &stress, Tangent3 *tangent) const override;
   std::string Validate(mfem::ElementTransformation &trans) const override;
   mfem::real_t AggregateModulus() const override;
   mfem::real_t ShearModulus() const override;

private:
   std::vector<const HyperelasticLaw *> parts;
};

} // namespace synovia
