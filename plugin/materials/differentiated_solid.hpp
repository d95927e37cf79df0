#pragma once

#include "synovia/materials/solid_law.hpp"

namespace synovia
{

/// A solid law whose tangent is found by dual numbers.
///
/// @a Own writes nothing but
///
///     template <typename T>
///     bool Stress(const MaterialPoint &point, const Tensor3<T> &F,
///                 Tensor3<T> &P) const;
///
/// with +, -, *, /, sqrt, exp, log and pow on the components of F.
template <typename Own>
class DifferentiatedSolid : public SolidLaw
{
public:
   bool GetStress(const MaterialPoint &point, const Tensor3<> &F,
                  Tensor3<> &stress, Tangent3 *tangent) const override
   {
      const Own &law = static_cast<const Own &>(*this);
      if (!tangent)
      {
         return law.Stress(point, F, stress) && IsFinite(stress);
      }
      Tensor3<Dual9> differentiated;
      if (!law.Stress(point, Independent(F), differentiated))
      {
         return false;
      }
      Separate(differentiated, stress, *tangent);
      return IsFinite(stress);
   }
};

} // namespace synovia
