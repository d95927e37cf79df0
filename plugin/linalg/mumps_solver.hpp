#pragma once

#include "synovia/linalg/direct_solver.hpp"

#ifdef MFEM_USE_MUMPS

#include "synovia/linalg/lone_unknowns.hpp"
#include "synovia/linalg/row_route.hpp"

#include <cstdint>
#include <optional>
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
      /// Rows of the matrix in the order of elimination, but for lone
      /// unknowns; on the root.
      std::vector<int> rows;
      double operations = 0.0;
      /// Of the matrix.
      HYPRE_BigInt size = 0;
   };

   /// Whether an ordering is to serve for several patterns, or a pattern for
   /// all that may touch.
   bool KeepsOrdering() const;
   /// Parts this rank's rows into lone unknowns and those that MUMPS gets.
   void Part(const mfem::SparseMatrix &coupled);
   /// How many unknowns MUMPS gets, of all ranks.
   int CountOfOthers() const;
   /// Sets @a y at lone unknowns.
   void SolveLone(const mfem::Vector &x, mfem::Vector &y) const;
   /// False if it fails for good.
   bool Analyze();
   bool Factorize();
   /// Where a matrix's ordering puts the @a others, its rows without lone
   /// unknowns, for MumpsInstance. Those that were lone come first.
   std::vector<int> Positions(const std::vector<int> &others) const;

   /// Throws why, and forgets the factors.
   [[noreturn]] void Fail(const std::string &task);

   MPI_Comm comm;
   MatrixKind kind;
   DirectOptions options;
   std::unique_ptr<MumpsInstance<Number>> instance;
   std::uint64_t pattern = 0;
   std::optional<LoneUnknowns> lone;
   /// This rank's rows that MUMPS gets, and those of lone unknowns with the
   /// inverse of their diagonal.
   mfem::Array<int> others_here;
   mfem::Array<int> lone_here;
   mfem::Vector lone_inverse;
   Ordering ordering;
   /// In percent; kept for the matrices to come once one has needed more.
   int workspace_margin = 20;
   HYPRE_BigInt first_row = 0;
   /// Of all ranks.
   HYPRE_BigInt rows = 0;
   /// Rows as MUMPS counts, from 1 and without lone unknowns: of right sides,
   /// and of solutions where it leaves them.
   std::vector<int> right_side_rows;
   mutable std::vector<int> solution_rows;
   /// Known once there is a solution.
   mutable std::unique_ptr<RowRoute> route;
};

} // namespace synovia

#endif
