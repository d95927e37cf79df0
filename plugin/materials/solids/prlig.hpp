#pragma once

#include "synovia/materials/differentiated_solid.hpp"
#include "synovia/materials/fiber_direction.hpp"

#include <algorithm>

namespace synovia
{

/// Ligaments, whose fibers draw in across more than they lengthen:
///
///     Psi = c1/(2 c2) (exp(c2 (l - 1)^2) - 1) + mu ((I1 - 3)/2 - ln J)
///           + k/2 (ln(a l^(-4 (m - v0)) exp(4 m (l - 1))))^2
///
/// with the stretch l along n and the squared ratio of areas across it,
/// a = |cof(F) n|^2 = n.C^2 n - I1 n.C n + I2. Without other stresses areas
/// follow from l; v0 is Poisson's ratio of small strains, and m changes it
/// (A. H. Swedberg, S. P. Reese, S. A. Maas, B. J. Ellis, J. A. Weiss, J.
/// Biomech. 47:3201-3209, 2014).
class Prlig : public DifferentiatedSolid<Prlig>
{
public:
   static LawDescription Describe()
   {
      LawDescription law = DescribeFibers(
         "prlig", "ligament with a large Poisson's ratio along its fibers",
         {{"c1",
           "stress",
           "the modulus c1 of the fibers",
           NumberRange::AtLeast(0.0),
           {}},
          {"c2", "", "the exponent c2", NumberRange::Positive(), {}},
          {"mu",
           "stress",
           "the shear modulus mu of the matrix",
           NumberRange::Positive(),
           {}},
          {"v0",
           "",
           "Poisson's ratio v0 of small strains",
           NumberRange::AtLeast(0.0),
           {}},
          {"m", "", "the change m of Poisson's ratio", {}, {}},
          {"k",
           "stress",
           "the modulus k of the change of volume",
           NumberRange::Positive(),
           {}}});
      law.is_fiber = false;
      return law;
   }

   explicit Prlig(const LawArguments &from)
      : Prlig({from["c1"], from["c2"], from["mu"], from["v0"], from["m"],
               from["k"]},
              FiberDirection(from))
   {
   }

   struct Constants
   {
      /// Stress.
      mfem::real_t c1;
      mfem::real_t c2;
      /// Stress.
      mfem::real_t mu;
      mfem::real_t v0;
      mfem::real_t m;
      /// Stress.
      mfem::real_t k;
   };
   /// Throws Error if they are out of range.
   Prlig(const Constants &constants, const FiberDirection &direction_)
      : of(constants), direction(direction_)
   {
      Describe().Verify({of.c1, of.c2, of.mu, of.v0, of.m, of.k});
   }

   template <typename T>
   bool Stress(const MaterialPoint &point, const Tensor3<T> &F,
               Tensor3<T> &P) const
   {
      using std::exp;
      using std::log;
      using std::sqrt;
      const Vector3<> n = direction(point);
      const Tensor3<T> cofactor = Cofactor(F);
      const T J = Determinant(F, cofactor);
      const Vector3<T> stretched = Product(F, n);
      const T stretch = sqrt(InnerProduct(stretched, stretched));
      const Vector3<T> turned_area = Product(cofactor, n);
      const T area = InnerProduct(turned_area, turned_area);
      const T excess = stretch - 1.0;
      const T volume =
         log(area) - 4.0 * (of.m - of.v0) * log(stretch) + 4.0 * of.m * excess;
      P = of.mu * F - (of.mu / J) * cofactor;
      const T along =
         of.c1 * excess * exp(of.c2 * excess * excess) +
         of.k * volume * (4.0 * of.m - 4.0 * (of.m - of.v0) / stretch);
      AddOuterProduct(along / stretch, stretched, n, P);
      // d ln a / dF, a = J^2 n.C^-1 n: twice what is across cof(F) n in
      // cof(F)/J.
      const T across = 2.0 * of.k * volume / J;
      P = P + across * cofactor;
      Vector3<T> back;
      for (int j = 0; j < 3; j++)
      {
         back[j] = cofactor[0][j] * turned_area[0] +
                   cofactor[1][j] * turned_area[1] +
                   cofactor[2][j] * turned_area[2];
      }
      AddOuterProduct(-1.0 * across / area, turned_area, back, P);
      return true;
   }

   std::string Validate(mfem::ElementTransformation &trans) const override
   {
      return direction.Validate(trans);
   }
   /// The lesser of those across and along the fibers.
   mfem::real_t AggregateModulus() const override
   {
      return std::min(4.0 * of.k, 16.0 * of.k * of.v0 * of.v0 + of.c1) +
             2.0 * of.mu;
   }
   mfem::real_t ShearModulus() const override { return of.mu; }

private:
   Constants of;
   FiberDirection direction;
};

} // namespace synovia
