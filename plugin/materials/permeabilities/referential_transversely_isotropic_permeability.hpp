#pragma once

#include "synovia/materials/differentiated_permeability.hpp"
#include "synovia/materials/fiber_direction.hpp"
#include "synovia/materials/law_arguments.hpp"
#include "synovia/materials/law_description.hpp"
#include "synovia/materials/pore_growth.hpp"

namespace synovia
{

/// Constants of a permeability that differs along (axial) and across
/// (transverse) an axis of the undeformed body (length^4 / (force time)).
struct AxialPermeabilities
{
   mfem::real_t k0;
   mfem::real_t k1_transverse;
   mfem::real_t k1_axial;
   mfem::real_t k2_transverse;
   mfem::real_t k2_axial;
};

/// Transversely isotropic in the undeformed body, about the axis V = theta of a
/// frame: with b = F F^T and m = (F V) (x) (F V),
///
///     k = k_0 f_0 I + a_T b + (a_A - a_T) m + 2 c_T b^2
///         + (c_A - c_T) (m b + b m),
///     a_x = k_1x/J^2 f_x, c_x = k_2x/(2 J^4) f_x, f_x as in PoreGrowth
///
/// (Ateshian & Weiss, J Biomech Eng 132(11):111004, 2010).
class ReferentialTransverselyIsotropicPermeability
   : public DifferentiatedPermeability<
        ReferentialTransverselyIsotropicPermeability>
{
public:
   static LawDescription Describe();

   explicit ReferentialTransverselyIsotropicPermeability(
      const LawArguments &from);
   /// The growths have one solid fraction. Throws Error if constants are out of
   /// range, or if nothing flows along the axis or across it.
   ReferentialTransverselyIsotropicPermeability(
      const AxialPermeabilities &constants, const PoreGrowth &growth,
      const PoreGrowth &transverse, const PoreGrowth &axial,
      const FiberDirection &direction);

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
      const T f_transverse = transverse(J);
      const T f_axial = axial(J);
      const T cubed = J * J * J;
      // Times J, for K = J F^-1 k F^-T.
      const T a_transverse = constants.k1_transverse * f_transverse / J;
      const T a_axial = constants.k1_axial * f_axial / J;
      const T c_transverse =
         0.5 * constants.k2_transverse * f_transverse / cubed;
      const T c_axial = 0.5 * constants.k2_axial * f_axial / cubed;
      const Tensor3<T> C = TransposedProduct(F, F);
      K = (constants.k0 * growth(J) / J) *
             TransposedProduct(cofactor, cofactor) +
          (2.0 * c_transverse) * C;
      const Vector3<> axis = direction(point);
      const Vector3<T> strained = Product(C, axis);
      for (int i = 0; i < 3; i++)
      {
         K[i][i] = K[i][i] + a_transverse;
      }
      AddOuterProduct(a_axial - a_transverse, axis, axis, K);
      AddOuterProduct(c_axial - c_transverse, axis, strained, K);
      AddOuterProduct(c_axial - c_transverse, strained, axis, K);
      return true;
   }

   std::string Validate(mfem::ElementTransformation &trans) const override
   {
      return direction.Validate(trans);
   }

   /// The mean over all directions.
   mfem::real_t ReferenceValue() const override;

private:
   mfem::real_t Across() const;
   mfem::real_t Along() const;

   AxialPermeabilities constants;
   PoreGrowth growth;
   PoreGrowth transverse;
   PoreGrowth axial;
   FiberDirection direction;
};

} // namespace synovia
