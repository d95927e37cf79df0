#pragma once

#include "synovia/materials/differentiated_permeability.hpp"
#include "synovia/materials/law_arguments.hpp"
#include "synovia/materials/material_frame.hpp"
#include "synovia/materials/pore_growth.hpp"

#include <array>

namespace synovia
{

/// Orthotropic in the undeformed body, about the axes V_a = r, theta, z of a
/// frame: with b = F F^T and m_a = (F V_a) (x) (F V_a),
///
///     k = k_0 f_0 I + sum_a (k_1a/J^2 f_a m_a
///                            + k_2a/(2 J^4) f_a (m_a b + b m_a)),
///
/// f_0 and f_a as in PoreGrowth (Ateshian & Weiss, J Biomech Eng
/// 132(11):111004, 2010).
class ReferentialOrthotropicPermeability
   : public DifferentiatedPermeability<ReferentialOrthotropicPermeability>
{
public:
   /// Along one axis (length^4 / (force time)).
   struct Along
   {
      mfem::real_t k1;
      mfem::real_t k2;
      PoreGrowth growth;
   };

   static LawDescription Describe();

   explicit ReferentialOrthotropicPermeability(const LawArguments &from);
   /// Along r, theta and z; the growths have one solid fraction. Borrows
   /// @a frame. Throws Error if constants are out of range, or if nothing flows
   /// along an axis.
   ReferentialOrthotropicPermeability(mfem::real_t k0, const PoreGrowth &growth,
                                      const std::array<Along, 3> &along,
                                      const MaterialFrame &frame);

   template <typename T>
   bool Referential(const MaterialPoint &point, const Tensor3<T> &F,
                    Tensor3<T> &K) const
   {
      const Tensor3<T> cofactor = Cofactor(F);
      const T J = Determinant(F, cofactor);
      if (!(J > growth.solid_fraction))
      {
         return false;
      }
      const Tensor3<T> C = TransposedProduct(F, F);
      // Times J, for K = J F^-1 k F^-T.
      K = (k0 * growth(J) / J) * TransposedProduct(cofactor, cofactor);
      const Tensor3<> axes = frame.GetAxes(point);
      for (int a = 0; a < 3; a++)
      {
         const Vector3<> axis{axes[0][a], axes[1][a], axes[2][a]};
         const Vector3<T> strained = Product(C, axis);
         const T f = along[a].growth(J);
         const T first = along[a].k1 * f / J;
         const T second = 0.5 * along[a].k2 * f / (J * J * J);
         AddOuterProduct(first, axis, axis, K);
         AddOuterProduct(second, axis, strained, K);
         AddOuterProduct(second, strained, axis, K);
      }
      return true;
   }

   std::string Validate(mfem::ElementTransformation &trans) const override
   {
      return frame.Validate(trans);
   }

   /// The mean over all directions.
   mfem::real_t ReferenceValue() const override;

private:
   mfem::real_t k0;
   PoreGrowth growth;
   std::array<Along, 3> along;
   const MaterialFrame &frame;
};

} // namespace synovia
