#pragma once

#include "mfem.hpp"

#include <vector>

namespace synovia
{

/// Solves A x = b for a few right sides at once, by conjugate residuals
/// (Eisenstat, Elman & Schultz, SIAM J Numer Anal 20:345-357, 1983) in
/// directions that all of them share: an iteration preconditions all residuals
/// together, and each solution takes the best of all directions so far.
///
/// For few iterations, as each direction is kept and takes two vectors.
class SharedDirections
{
public:
   /// Borrows both.
   SharedDirections(MPI_Comm comm, const mfem::Operator &a,
                    const mfem::Operator &preconditioner);

   /// Improves @a x, as many vectors as @a b has, until the norm of each
   /// residual is at most its target, but no longer than @a most iterations.
   /// Collective.
   void Solve(int most, const std::vector<mfem::Vector> &b,
              const mfem::Vector &targets, std::vector<mfem::Vector> &x);

private:
   struct Direction
   {
      mfem::Vector z;
      /// A z, of length 1.
      mfem::Vector product;
   };

   std::vector<mfem::Vector> Precondition(const std::vector<mfem::Vector> &r);
   /// Makes A z normal to all products so far and takes it in, unless nothing
   /// is left of it. Says whether it did.
   bool Append(mfem::Vector &&z);
   mfem::Vector Products(const mfem::Vector &y) const;

   MPI_Comm comm;
   const mfem::Operator &a;
   const mfem::Operator &preconditioner;
   std::vector<Direction> directions;
};

} // namespace synovia
