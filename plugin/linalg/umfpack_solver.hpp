#pragma once

#include "mfem.hpp"

#ifdef MFEM_USE_SUITESPARSE

#include <array>
#include <memory>
#include <string>
#include <vector>

namespace synovia
{

/// Factors of a matrix that is all on one rank, by UMFPACK.
///
/// MFEM's own interface ends the program if a factorization fails; this one
/// throws FactorizationError and can go on with another matrix.
class UmfpackSolver final : public mfem::Solver
{
public:
   /// @a memory_limit in MB, 0 for none, is compared with what UMFPACK foresees
   /// as the most that it may need.
   explicit UmfpackSolver(int memory_limit);

   /// Factorizes a HypreParMatrix.
   void SetOperator(const mfem::Operator &op) override;
   void Mult(const mfem::Vector &x, mfem::Vector &y) const override;

private:
   using Index = SuiteSparse_long;
   using Factors = std::unique_ptr<void, void (*)(void *)>;

   void Analyze();
   void Factorize();
   /// How a message about a task that failed begins.
   std::string Failing(const std::string &task) const;

   double memory_limit;
   /// The most that a factorization may take (MB).
   double foreseen_memory = 0.0;
   std::array<double, UMFPACK_CONTROL> control;
   /// Rows, which are columns as well.
   std::vector<Index> begins;
   std::vector<Index> indices;
   std::vector<double> entries;
   Factors symbolic;
   Factors numeric;
};

} // namespace synovia

#endif
