#pragma once

#include "synovia/materials/isotropic_permeability.hpp"
#include "synovia/materials/law_arguments.hpp"
#include "synovia/materials/law_description.hpp"

namespace synovia
{

/// The same permeability everywhere in space: k = value I, whatever the
/// deformation.
class ConstantPermeability : public IsotropicPermeability<ConstantPermeability>
{
public:
   static LawDescription Describe()
   {
      return {"constant",
              "the same everywhere, whatever the deformation",
              {},
              {ReferencePermeability()}};
   }

   explicit ConstantPermeability(const LawArguments &from)
      : ConstantPermeability(from["value"])
   {
   }
   /// Throws Error unless @a value is positive.
   explicit ConstantPermeability(mfem::real_t value_) : value(value_)
   {
      Describe().Verify({value});
   }

   template <typename T>
   bool Spatial(const MaterialPoint &, const T &, T &k) const
   {
      k = value;
      return true;
   }

   mfem::real_t ReferenceValue() const override { return value; }

private:
   mfem::real_t value;
};

} // namespace synovia
