#include "synovia/linalg/filtered_amg.hpp"
#include "synovia/general/reduce.hpp"
#include "synovia/general/vector_entries.hpp"
#include "synovia/linalg/biphasic_jacobian.hpp"

#include <algorithm>

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

// Marks the local true dofs in which those rows of a distributed matrix have
// entries that are positive in @a rows.
void MarkColumns(const HypreParMatrix &matrix, const Vector &rows,
                 Array<int> &marker)
{
   Vector weight(matrix.Width());
   // |entries| can't cancel.
   matrix.AbsMultTranspose(1.0, rows, 0.0, weight);
   weight.HostRead();
   for (int i = 0; i < weight.Size(); i++)
   {
      // Normals along an axis leave round-off in the other components.
      if (weight[i] > 1e-10)
      {
         marker[i] = 1;
      }
   }
}

// Marks what a sum of matrices couples to marked dofs as well.
void MarkNeighbors(const FilteredAmg::Matrices &terms, Array<int> &marker)
{
   Vector marked(marker.Size());
   for (int i = 0; i < marked.Size(); i++)
   {
      marked[i] = marker[i];
   }
   Vector weight(marker.Size());
   weight = 0.0;
   for (const HypreParMatrix *term : terms)
   {
      term->AbsMult(1.0, marked, 1.0, weight);
   }
   weight.HostRead();
   for (int i = 0; i < weight.Size(); i++)
   {
      if (weight[i] > 0.0)
      {
         marker[i] = 1;
      }
   }
}

void Unmark(const Array<int> &dofs, Array<int> &marker)
{
   for (const int dof : dofs)
   {
      marker[dof] = 0;
   }
}
} // namespace

FilteredAmg::FilteredAmg(Matrices terms_, const Array<int> &prescribed_,
                         const Array<int> &exact_, int overlap_,
                         MatrixKind kind_, const DirectOptions &options_)
   : Solver(terms_.at(0)->Height()), terms(std::move(terms_)),
     prescribed(prescribed_), exact(exact_),
     has_exact(AnyRank(exact.Size() > 0, terms[0]->GetComm())),
     overlap(overlap_), kind(kind_), options(options_), residual(height)
{
   options.single_precision = options.single_precision && has_exact;
}

void FilteredAmg::SetHierarchy(std::unique_ptr<HypreParMatrix> alike_,
                               std::unique_ptr<HypreBoomerAMG> amg_)
{
   ClearHierarchy();
   alike = std::move(alike_);
   if (has_exact)
   {
      delete alike->EliminateRowsCols(exact);
   }
   amg = std::move(amg_);
   selected.reset();
   amg->SetPrintLevel(0);
   amg->SetOperator(*alike);
   // hypre sets up at the first use: now, while it can be timed as set-up.
   residual = 0.0;
   Vector nothing(height);
   amg->Mult(residual, nothing);
}

void FilteredAmg::ClearHierarchy()
{
   amg.reset();
   alike.reset();
}

void FilteredAmg::SetOperator(const Operator &)
{
   MFEM_ABORT("the filtered multigrid keeps its operator");
}

Array<int> FilteredAmg::Touched(int size, const Factors &factors)
{
   Array<int> marker(size);
   marker = 0;
   for (const Factor &factor : factors)
   {
      Vector all(factor.forces->Height());
      all = 1.0;
      MarkColumns(*factor.forces, all, marker);
   }
   return marker;
}

void FilteredAmg::SetFactors(const Factors &factors_)
{
   factors = factors_;
   selected.reset();
}

void FilteredAmg::Replace(Matrices terms_, const Factors &factors_)
{
   terms = std::move(terms_);
   factors = factors_;
}

Array<int> FilteredAmg::Needed(const std::vector<Vector> &weights,
                               const std::vector<Vector> &in_hierarchy) const
{
   Array<int> marker(height);
   marker = 0;
   for (size_t i = 0; i < factors.size(); i++)
   {
      Vector rows(weights[i].Size());
      for (int j = 0; j < rows.Size(); j++)
      {
         const bool known = !in_hierarchy.empty() && in_hierarchy[i][j] > 0.0;
         rows[j] = known || weights[i][j] > 0.0 ? 1.0 : 0.0;
      }
      MarkColumns(*factors[i].forces, rows, marker);
   }
   for (const int dof : OnHost(held))
   {
      marker[dof] = 1;
   }
   for (const int dof : exact)
   {
      marker[dof] = 1;
   }
   Unmark(prescribed, marker);
   return marker;
}

bool FilteredAmg::Select(const Array<int> &needed)
{
   bool other = !selected;
   if (other)
   {
      selected = needed;
   }
   for (int i = 0; i < height; i++)
   {
      if (needed[i] > (*selected)[i])
      {
         (*selected)[i] = 1;
         other = true;
      }
   }
   return AnyRank(other, terms[0]->GetComm());
}

void FilteredAmg::Restrict()
{
   Array<int> marker(*selected);
   for (int layer = 0; layer < overlap; layer++)
   {
      MarkNeighbors(terms, marker);
      Unmark(prescribed, marker);
   }
   contact_dofs.SetSize(0);
   for (int i = 0; i < height; i++)
   {
      if (marker[i])
      {
         contact_dofs.Append(i);
      }
   }
   contact_solver.reset();
   penalties.reset();
   forces_in_contact.clear();
   changes_in_contact.clear();
   has_contact = AnyRank(contact_dofs.Size() > 0, terms[0]->GetComm());
   if (!has_contact)
   {
      return;
   }
   small_residual.SetSize(contact_dofs.Size());
   small_correction.SetSize(contact_dofs.Size());
   first.SetSize(contact_dofs.Size());
   const std::unique_ptr<HypreParMatrix> injection =
      Injection(*terms[0], contact_dofs);
   contact_columns = Columns(*injection);
   const std::unique_ptr<HypreParMatrix> restriction(injection->Transpose());
   matrix_in_contact.reset(
      ParMult(restriction.get(), contact_columns.get(), true));
   Vector counts(height);
   counts = 1.0;
   counts.SetSubVector(prescribed, 0.0);
   contact_columns->ScaleRows(counts);
   // Between bodies that only multigrid solves for, R beside a hierarchy that
   // doesn't know it takes up to twice as many iterations as F for it.
   for (const Factor &factor : factors)
   {
      forces_in_contact.emplace_back(
         ParMult(factor.forces, injection.get(), true));
      changes_in_contact.emplace_back(
         factor.changes == factor.forces || !has_exact
            ? nullptr
            : ParMult(factor.changes, injection.get(), true));
   }
}

std::unique_ptr<HypreParMatrix>
FilteredAmg::Columns(const HypreParMatrix &injection) const
{
   std::unique_ptr<HypreParMatrix> sum;
   for (const HypreParMatrix *term : terms)
   {
      AddTo(sum,
            std::unique_ptr<HypreParMatrix>(ParMult(term, &injection, true)));
   }
   return sum;
}

bool FilteredAmg::SetWeights(const std::vector<Vector> &weights,
                             const std::vector<Vector> &in_hierarchy)
{
   if (Select(Needed(weights, in_hierarchy)))
   {
      Restrict();
   }
   if (!has_contact)
   {
      return false;
   }
   penalties.reset();
   for (size_t i = 0; i < forces_in_contact.size(); i++)
   {
      const HypreParMatrix &forces = *forces_in_contact[i];
      AddTo(penalties,
            WeightedProduct(forces, weights[i],
                            changes_in_contact[i] ? *changes_in_contact[i]
                                                  : forces));
   }
   const std::unique_ptr<HypreParMatrix> whole(
      penalties ? Add(1.0, *matrix_in_contact, 1.0, *penalties)
                : new HypreParMatrix(*matrix_in_contact));
   HoldContact(*whole);
   try
   {
      Factorize(*whole);
   }
   catch (const FactorizationError &)
   {
      if (!RefineFactors())
      {
         throw;
      }
      Factorize(*whole);
   }
   return true;
}

void FilteredAmg::Factorize(const HypreParMatrix &in_contact)
{
   if (contact_solver)
   {
      contact_solver->SetOperator(in_contact);
   }
   else
   {
      contact_solver = MakeDirectSolver(
         in_contact, IsSymmetric() ? kind : MatrixKind::general, options);
   }
}

bool FilteredAmg::IsSymmetric() const
{
   return std::all_of(changes_in_contact.begin(), changes_in_contact.end(),
                      [](const std::unique_ptr<HypreParMatrix> &changes)
                      { return !changes; });
}

bool FilteredAmg::RefineFactors()
{
   if (!options.single_precision)
   {
      return false;
   }
   options.single_precision = false;
   contact_solver.reset();
   return true;
}

void FilteredAmg::HoldContact(HypreParMatrix &in_contact)
{
   held_in_contact.SetSize(0);
   for (const int dof : OnHost(held))
   {
      const int place = contact_dofs.FindSorted(dof);
      MFEM_VERIFY(place >= 0 || prescribed.FindSorted(dof) >= 0,
                  "a held dof is not one that contact touches");
      if (place >= 0)
      {
         held_in_contact.Append(place);
      }
   }
   in_contact.EliminateBC(held_in_contact, DIAG_ONE);
}

void FilteredAmg::Mult(const Vector &x, Vector &y) const
{
   if (!has_contact)
   {
      amg->Mult(x, y);
      return;
   }
   x.GetSubVector(contact_dofs, small_residual);
   small_residual.SetSubVector(held_in_contact, 0.0);
   contact_solver->Mult(small_residual, first);

   residual = x;
   contact_columns->Mult(-1.0, first, 1.0, residual);
   if (penalties)
   {
      penalties->Mult(-1.0, first, 0.0, small_residual);
      residual.AddElementVector(contact_dofs, small_residual);
   }
   residual.SetSubVector(held, 0.0);
   amg->Mult(residual, y);
   y.SetSubVector(held, 0.0);

   // The first solve left no residual at the contact's dofs: what they have
   // now is due to the V-cycle.
   y.GetSubVector(contact_dofs, small_correction);
   contact_columns->MultTranspose(-1.0, y, 0.0, small_residual);
   if (penalties)
   {
      penalties->Mult(-1.0, small_correction, 1.0, small_residual);
   }
   small_residual.SetSubVector(held_in_contact, 0.0);
   contact_solver->Mult(small_residual, small_correction);
   small_correction += first;
   y.AddElementVector(contact_dofs, small_correction);
   CopyEntries(held, x, y);
}

} // namespace synovia
