#include "solvers/direct_solver.hpp"
#include "general/error.hpp"

namespace synovia
{

using namespace mfem;

namespace
{
#ifndef MFEM_USE_MUMPS
#ifdef MFEM_USE_SUITESPARSE
/// UMFPACK on the one rank's part of a distributed matrix.
class SerialDirectSolver : public Solver
{
public:
   explicit SerialDirectSolver(const HypreParMatrix &matrix)
      : Solver(matrix.Height())
   {
      SparseMatrix local;
      matrix.MergeDiagAndOffd(local);
      own = local;
      umfpack.SetOperator(own);
   }
   void SetOperator(const Operator &) override
   {
      MFEM_ABORT("a factorisation keeps its matrix");
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
   auto solver = std::make_unique<MUMPSSolver>(matrix.GetComm());
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
