#pragma once

#include "synovia/materials/fiber_solid.hpp"

#include <cmath>

namespace synovia
{

/// Psi = xi/(alpha beta) (exp(alpha (I_n - lambda_0^2)^beta) - 1), whose limit
/// for alpha = 0 is xi/beta (I_n - lambda_0^2)^beta, and a resistance to shear
/// of taut fibers, mu/4 (n_0 . C^2 n_0 - 2 (I_n - 1) - 1) (Ateshian, Rajan,
/// Chahine, Canal & Hung, J Biomech Eng 131(6):061003, 2009).
class FiberExpPow : public FiberSolid<FiberExpPow>
{
public:
   static LawDescription Describe();

   explicit FiberExpPow(const LawArguments &from);
   /// @a xi and @a mu are stresses, @a taut is lambda_0. Throws Error if they
   /// are out of range.
   FiberExpPow(mfem::real_t alpha, mfem::real_t beta, mfem::real_t xi,
               mfem::real_t mu, mfem::real_t taut,
               const FiberDirection &direction);

   template <typename T>
   bool Stress(const MaterialPoint &point, const Tensor3<T> &F,
               Tensor3<T> &P) const
   {
      FiberSolid::Stress(point, F, P);
      if (mu == 0.0)
      {
         return true;
      }
      const Vector3<> n = direction(point);
      const Vector3<T> stretched = Product(F, n);
      T square = InnerProduct(stretched, stretched);
      if (IsTaut(taut_square, square))
      {
         // C n - n
         Vector3<T> strain = Product(TransposedProduct(F, F), n);
         for (int i = 0; i < 3; i++)
         {
            strain[i] = strain[i] - n[i];
         }
         AddOuterProduct(0.5 * mu, stretched, strain, P);
         AddOuterProduct(0.5 * mu, Product(F, strain), n, P);
      }
      return true;
   }

   mfem::real_t Threshold() const override { return taut_square; }
   /// Not with a resistance to shear.
   bool DependsOnStretchOnly() const override { return mu == 0.0; }
   template <typename T>
   T EnergyDerivative(const T &square) const
   {
      using std::exp;
      using std::pow;
      const T excess = square - taut_square;
      const T stress = xi * pow(excess, beta - 1.0);
      return alpha > 0.0 ? stress * exp(alpha * pow(excess, beta)) : stress;
   }

private:
   mfem::real_t alpha;
   mfem::real_t beta;
   mfem::real_t xi;
   mfem::real_t mu;
   mfem::real_t taut_square;
};

} // namespace synovia
