#pragma once

#include "synovia/materials/permeability_law.hpp"

namespace synovia
{

/// A permeability law whose derivative is found by dual numbers. @a Own writes
///
///     template <typename T>
///     bool Referential(const MaterialPoint &point, const Tensor3<T> &F,
///                      Tensor3<T> &K) const;
///
/// with +, -, *, /, sqrt, exp, log and pow on the components of F.
template <typename Own>
class DifferentiatedPermeability : public PermeabilityLaw
{
public:
   bool GetReferential(const MaterialPoint &point, const Tensor3<> &F,
                       Tensor3<> &permeability,
                       Tangent3 *tangent) const override
   {
      const Own &law = static_cast<const Own &>(*this);
      if (!tangent)
      {
         return law.Referential(point, F, permeability);
      }
      Tensor3<Dual9> differentiated;
      if (!law.Referential(point, Independent(F), differentiated))
      {
         return false;
      }
      Separate(differentiated, permeability, *tangent);
      return true;
   }
};

} // namespace synovia
