#include "solvers/direct_solver.hpp"
#include "general/error.hpp"
#include "general/reduce.hpp"

#include <cstdint>

namespace synovia
{

using namespace mfem;

namespace
{
#ifdef MFEM_USE_MUMPS
/// A number that tells apart where matrices have their entries (FNV-1a).
class PatternHash
{
public:
   explicit PatternHash(const HypreParMatrix &matrix)
   {
      SparseMatrix diagonal;
      SparseMatrix others;
      HYPRE_BigInt *columns = nullptr;
      matrix.GetDiag(diagonal);
      matrix.GetOffd(others, columns);
      Add(diagonal);
      Add(others);
      Add(columns, others.Width());
   }
   std::uint64_t Value() const { return value; }

private:
   template <typename Index>
   void Add(const Index *indices, int count)
   {
      constexpr std::uint64_t prime = 1099511628211u;
      for (int i = 0; i < count; i++)
      {
         value = (value ^ static_cast<std::uint64_t>(indices[i])) * prime;
      }
   }
   void Add(const SparseMatrix &part)
   {
      Add(part.HostReadI(), part.Height() + 1);
      Add(part.HostReadJ(), part.NumNonZeroElems());
   }

   std::uint64_t value = 14695981039346656037u;
};

/// Orders anew only if entries are at other places.
class OrderedMumps : public MUMPSSolver
{
public:
   explicit OrderedMumps(MPI_Comm comm_) : MUMPSSolver(comm_), comm(comm_) {}

   void SetOperator(const Operator &op) override
   {
      const std::uint64_t now =
         PatternHash(dynamic_cast<const HypreParMatrix &>(op)).Value();
      SetReorderingReuse(!AnyRank(now != pattern, comm));
      pattern = now;
      MUMPSSolver::SetOperator(op);
   }

private:
   MPI_Comm comm;
   std::uint64_t pattern = 0;
};
#else
#ifdef MFEM_USE_SUITESPARSE
/// UMFPACK on the one rank's part of a distributed matrix.
class SerialDirectSolver final : public Solver
{
public:
   explicit SerialDirectSolver(const HypreParMatrix &matrix)
      : Solver(matrix.Height())
   {
      SetOperator(matrix);
   }
   void SetOperator(const Operator &matrix) override
   {
      SparseMatrix local;
      dynamic_cast<const HypreParMatrix &>(matrix).MergeDiagAndOffd(local);
      own = local;
      umfpack.SetOperator(own);
   }
   void Mult(const Vector &x, Vector &y) const override { umfpack.Mult(x, y); }

private:
   SparseMatrix own;
   UMFPackSolver umfpack;
};
#endif
#endif
} // namespace

std::unique_ptr<Solver> MakeDirectSolver(const HypreParMatrix &matrix,
                                         MatrixKind kind)
{
#ifdef MFEM_USE_MUMPS
   auto solver = std::make_unique<OrderedMumps>(matrix.GetComm());
   solver->SetMatrixSymType(kind == MatrixKind::positive_definite
                               ? MUMPSSolver::SYMMETRIC_POSITIVE_DEFINITE
                               : MUMPSSolver::SYMMETRIC_INDEFINITE);
   solver->SetPrintLevel(0);
   solver->SetOperator(matrix);
   return solver;
#else
   (void)kind;
#ifdef MFEM_USE_SUITESPARSE
   int size;
   MPI_Comm_size(matrix.GetComm(), &size);
   if (size == 1)
   {
      return std::make_unique<SerialDirectSolver>(matrix);
   }
#endif
   throw Error("this MFEM has no direct solver for this number of ranks; build "
               "it with MUMPS");
#endif
}

} // namespace synovia
