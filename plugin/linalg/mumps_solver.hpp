#pragma once

#include "synovia/linalg/direct_solver.hpp"

#ifdef MFEM_USE_MUMPS

#include "synovia/linalg/row_route.hpp"

#include <cstdint>
#include <vector>

namespace synovia
{

template <typename Number>
class MumpsInstance;

/// Factors of a distributed matrix, by MUMPS, with entries of this type: those
/// in single precision take half the time and memory, and are a preconditioner.
///
/// MFEM's own interface ends the program if a factorization fails; this one
/// throws FactorizationError, and can go on with another matrix.
template <typename Number>
class MumpsSolver final : public mfem::Solver
{
public:
   MumpsSolver(MPI_Comm comm, MatrixKind kind, const DirectOptions &options);
   /// Collective.
   ~MumpsSolver() override;

   /// Factorizes a HypreParMatrix. Another sparsity pattern than the last one's
   /// is ordered anew only if the ordering that there is would take many more
   /// operations. Collective, as solves are.
   void SetOperator(const mfem::Operator &op) override;
   void Mult(const mfem::Vector &x, mfem::Vector &y) const override;
   void ArrayMult(const mfem::Array<const mfem::Vector *> &x,
                  mfem::Array<mfem::Vector *> &y) const override;

private:
   /// An ordering that MUMPS found.
   struct Ordering
   {
      /// As MumpsInstance has them.
      std::vector<int> positions;
      double operations = 0.0;
      int rows = 0;
   };

   /// Whether an ordering is to serve for several patterns, or a pattern for
   /// all that may touch.
   bool KeepsOrdering() const;
   bool Analyze();
   /// False if it fails for good.
   bool Factorize();
   /// Throws why, and forgets the factors.
   [[noreturn]] void Fail(const std::string &task);

   MPI_Comm comm;
   MatrixKind kind;
   DirectOptions options;
   std::unique_ptr<MumpsInstance<Number>> instance;
   std::uint64_t pattern = 0;
   Ordering ordering;
   /// In percent; kept for the matrices to come once one has needed more.
   int workspace_margin = 20;
   HYPRE_BigInt first_row = 0;
   /// Rows as MUMPS counts, from 1: of right sides, and of solutions where it
   /// leaves them.
   std::vector<int> right_side_rows;
   mutable std::vector<int> solution_rows;
   /// Known once there is a solution.
   mutable std::unique_ptr<RowRoute> route;
};

} // namespace synovia

#endif
