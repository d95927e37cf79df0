#include "solvers/contact_filter.hpp"
#include "general/reduce.hpp"
#include "solvers/direct_solver.hpp"

namespace synovia
{

using namespace mfem;

namespace
{
// Picks the dofs out of a vector: rows x dofs, one entry a row... its transpose
// puts them back.
std::unique_ptr<HypreParMatrix> Injection(const HypreParMatrix &square,
                                          const Array<int> &dofs)
{
   MPI_Comm comm = square.GetComm();
   HYPRE_BigInt local = dofs.Size();
   HYPRE_BigInt end = 0;
   MPI_Scan(&local, &end, 1, HYPRE_MPI_BIG_INT, MPI_SUM, comm);
   HYPRE_BigInt columns = 0;
   MPI_Allreduce(&local, &columns, 1, HYPRE_MPI_BIG_INT, MPI_SUM, comm);
   HYPRE_BigInt column_offsets[2] = {end - local, end};

   SparseMatrix injection(square.Height(), dofs.Size());
   for (int j = 0; j < dofs.Size(); j++)
   {
      injection.Set(dofs[j], j, 1.0);
   }
   injection.Finalize();
   HYPRE_BigInt row_offsets[2] = {square.RowPart()[0], square.RowPart()[1]};
   const HypreParMatrix borrowed(comm, square.GetGlobalNumRows(), columns,
                                 row_offsets, column_offsets, &injection);
   // A copy owns its offsets and entries.
   return std::make_unique<HypreParMatrix>(borrowed);
}

// Columns that a distributed matrix has entries in, as local true dofs.
void MarkColumns(const HypreParMatrix &matrix, Array<int> &marker)
{
   Vector ones(matrix.Height());
   ones = 1.0;
   Vector weight(matrix.Width());
   // |entries| can't cancel.
   matrix.AbsMultTranspose(1.0, ones, 0.0, weight);
   for (int i = 0; i < weight.Size(); i++)
   {
      // Normals along an axis leave round-off in the other components.
      if (weight[i] > 1e-10)
      {
         marker[i] = 1;
      }
   }
}
} // namespace

FilteredAmg::FilteredAmg(const BiphasicJacobian &jacobian_,
                         ParFiniteElementSpace &displacement)
   : Solver(displacement.GetTrueVSize()), jacobian(jacobian_),
     stiffness(std::make_unique<HypreParMatrix>(*jacobian.Volume().stiffness))
{
   stiffness->EliminateBC(jacobian.DisplacementDofs(), DIAG_ONE);
   amg.SetPrintLevel(0);
   amg.SetOperator(*stiffness);
   amg.SetSystemsOptions(3, false);
   // One level of aggressive coarsening costs a few iterations and saves more
   // on each of them.
   amg.SetAggressiveCoarsening(1);
   Vector x(height);
   Vector y(height);
   x = 0.0;
   amg.Mult(x, y);
}

void FilteredAmg::SetOperator(const Operator &)
{
   MFEM_ABORT("the filtered multigrid keeps its operator");
}

void FilteredAmg::UpdateSubspace()
{
   Array<int> marker(height);
   marker = 0;
   for (const ContactPair *pair : jacobian.Pairs())
   {
      MarkColumns(*pair->Operators().gap, marker);
   }
   for (const int dof : jacobian.DisplacementDofs())
   {
      marker[dof] = 0;
   }
   contact_dofs.SetSize(0);
   for (int i = 0; i < height; i++)
   {
      if (marker[i])
      {
         contact_dofs.Append(i);
      }
   }
   has_contact = AnyRank(contact_dofs.Size() > 0, stiffness->GetComm());
   contact_solver.reset();
   gaps_in_contact.clear();
   if (!has_contact)
   {
      return;
   }
   restriction = Injection(*stiffness, contact_dofs);
   stiffness_in_contact.reset(RAP(stiffness.get(), restriction.get()));
   for (const ContactPair *pair : jacobian.Pairs())
   {
      gaps_in_contact.emplace_back(
         ParMult(pair->Operators().gap.get(), restriction.get(), true));
   }
}

void FilteredAmg::UpdateWeights()
{
   if (!has_contact)
   {
      return;
   }
   std::unique_ptr<HypreParMatrix> matrix;
   for (size_t i = 0; i < gaps_in_contact.size(); i++)
   {
      const auto contact =
         WeightedSquare(*gaps_in_contact[i], jacobian.Pairs()[i]->GapWeights());
      const HypreParMatrix &so_far = matrix ? *matrix : *stiffness_in_contact;
      matrix.reset(Add(1.0, so_far, 1.0, *contact));
   }
   contact_solver = MakeDirectSolver(*matrix, MatrixKind::positive_definite);
}

void FilteredAmg::Filter(const Vector &r, Vector &c) const
{
   small_residual.SetSize(contact_dofs.Size());
   small_correction.SetSize(contact_dofs.Size());
   r.GetSubVector(contact_dofs, small_residual);
   contact_solver->Mult(small_residual, small_correction);
   c.AddElementVector(contact_dofs, small_correction);
}

void FilteredAmg::Mult(const Vector &x, Vector &y) const
{
   if (!has_contact)
   {
      amg.Mult(x, y);
      return;
   }
   residual.SetSize(height);
   correction.SetSize(height);
   y = 0.0;
   Filter(x, y);
   jacobian.MultDisplacement(y, residual);
   subtract(x, residual, residual);
   amg.Mult(residual, correction);
   y += correction;
   jacobian.MultDisplacement(y, residual);
   subtract(x, residual, residual);
   Filter(residual, y);
}

} // namespace synovia
