#pragma once

#include "synovia/general/error.hpp"
#include "synovia/materials/differentiated_solid.hpp"
#include "synovia/materials/fiber_direction.hpp"
#include "synovia/materials/fiber_energy.hpp"

#include <algorithm>
#include <cmath>

namespace synovia
{

/// Fibers in a Mooney-Rivlin solid whose volume is resisted apart from its
/// shape:
///
///     Psi = c_1 (I_1 J^(-2/3) - 3) + c_2 (I_2 J^(-4/3) - 3) + k/2 (ln J)^2
///           + Psi_f(l),    l = J^(-1/3) |F n|,
///
///     l Psi_f' = c_3 (exp(c_4 (l - 1)) - 1)    for 1 < l < l_max,
///                c_5 l + c_6                   beyond, continuous,
///
/// and none where l is below 1. Without c_3 it follows from c_5, so that the
/// slope is continuous, too (J. A. Weiss, B. N. Maker, S. Govindjee, Comput.
/// Methods Appl. Mech. Eng. 135:107-128, 1996).
class TransIsoMooneyRivlin : public DifferentiatedSolid<TransIsoMooneyRivlin>
{
public:
   static LawDescription Describe()
   {
      const NumberRange not_negative = NumberRange::AtLeast(0.0);
      LawDescription law = DescribeFibers(
         "trans_iso_mooney_rivlin", "Mooney-Rivlin with fibers, uncoupled",
         {{"c1", "stress", "the coefficient c1 of I_1", not_negative, {}},
          {"c2", "stress", "the coefficient c2 of I_2", not_negative, 0.0},
          {"c3", "stress", "the factor c3 of the exponential", not_negative,
           0.0},
          {"c4", "", "the exponent c4", NumberRange::Positive(), {}},
          {"c5", "stress", "the modulus c5 of straight fibers", not_negative,
           0.0},
          {"lam_max",
           "",
           "the stretch lam_max of straight fibers",
           NumberRange::AtLeast(1.0),
           {}},
          {"k", "stress", "the bulk modulus k", NumberRange::Positive(), {}}});
      law.is_fiber = false;
      return law;
   }

   explicit TransIsoMooneyRivlin(const LawArguments &from)
      : TransIsoMooneyRivlin({from["c1"], from["c2"], from["c3"], from["c4"],
                              from["c5"], from["lam_max"], from["k"]},
                             FiberDirection(from))
   {
   }

   struct Constants
   {
      /// Stress.
      mfem::real_t c1;
      mfem::real_t c2;
      mfem::real_t c3;
      mfem::real_t c4;
      /// Stress.
      mfem::real_t c5;
      mfem::real_t lam_max;
      /// Stress.
      mfem::real_t k;
   };
   /// Throws Error if they are out of range, and if c1 and c2 are both zero.
   TransIsoMooneyRivlin(const Constants &constants,
                        const FiberDirection &direction_)
      : of(constants), direction(direction_)
   {
      Describe().Verify({of.c1, of.c2, of.c3, of.c4, of.c5, of.lam_max, of.k});
      if (!(of.c1 + of.c2 > 0.0))
      {
         throw Error("c1 and c2 of a Mooney-Rivlin solid are both zero; it "
                     "must resist shear");
      }
      const mfem::real_t growth = std::exp(of.c4 * (of.lam_max - 1.0));
      if (of.c3 == 0.0)
      {
         of.c3 = of.c5 / (of.c4 * growth);
      }
      offset = of.c3 * (growth - 1.0) - of.c5 * of.lam_max;
   }

   template <typename T>
   bool Stress(const MaterialPoint &point, const Tensor3<T> &F,
               Tensor3<T> &P) const
   {
      using std::log;
      using std::pow;
      const Tensor3<T> cofactor = Cofactor(F);
      const T J = Determinant(F, cofactor);
      if (!(ValueOf(J) > 0.0))
      {
         return false;
      }
      const Tensor3<T> C = TransposedProduct(F, F);
      const T shape = pow(J, -2.0 / 3.0);
      const T I1 = Trace(C);
      const T I2 = 0.5 * (I1 * I1 - Trace(Product(C, C)));
      const Vector3<> n = direction(point);
      const Vector3<T> stretched = Product(F, n);
      const T square = InnerProduct(stretched, stretched);
      const T tension = Tension(shape * square);
      const T along_f = 2.0 * of.c1 * shape + 2.0 * of.c2 * shape * shape * I1;
      const T along_inverse =
         (of.k * log(J) - (2.0 / 3.0) * of.c1 * shape * I1 -
          (4.0 / 3.0) * of.c2 * shape * shape * I2 - tension / 3.0) /
         J;
      const T along_fc = -2.0 * of.c2 * shape * shape;
      P = along_f * F + along_fc * Product(F, C) + along_inverse * cofactor;
      AddOuterProduct(tension / square, stretched, n, P);
      return true;
   }

   std::string Validate(mfem::ElementTransformation &trans) const override
   {
      return direction.Validate(trans);
   }
   mfem::real_t AggregateModulus() const override
   {
      return of.k + 4.0 / 3.0 * ShearModulus();
   }
   mfem::real_t ShearModulus() const override { return 2.0 * (of.c1 + of.c2); }

private:
   /// l Psi_f' for l^2.
   template <typename T>
   T Tension(T square) const
   {
      using std::exp;
      using std::sqrt;
      if (!IsTaut(1.0, square))
      {
         return 0.0 * square;
      }
      const T stretch = sqrt(square);
      if (ValueOf(stretch) < of.lam_max)
      {
         return of.c3 * (exp(of.c4 * (stretch - 1.0)) - 1.0);
      }
      return of.c5 * stretch + offset;
   }

   Constants of;
   mfem::real_t offset;
   FiberDirection direction;
};

} // namespace synovia
