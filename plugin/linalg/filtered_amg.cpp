#include "synovia/linalg/filtered_amg.hpp"
#include "synovia/general/profiled_work.hpp"
#include "synovia/general/reduce.hpp"
#include "synovia/general/vector_entries.hpp"
#include "synovia/linalg/biphasic_jacobian.hpp"
#include "synovia/linalg/bytes_read.hpp"
#include "synovia/linalg/injection.hpp"

namespace synovia
{

using namespace mfem;

namespace
{
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
                         const Array<int> &exact_, int overlap_, Filter filter_,
                         MatrixKind kind_, const DirectOptions &options_,
                         int most_columns)
   : Solver(terms_.at(0)->Height()), terms(std::move(terms_)),
     prescribed(prescribed_), exact(exact_),
     has_exact(AnyRank(exact.Size() > 0, terms[0]->GetComm())),
     overlap(overlap_), filter(filter_),
     in_contact(kind_, options_, most_columns), residual(height)
{
   Array<int> marker(height);
   marker = 1;
   Unmark(prescribed, marker);
   Unmark(exact, marker);
   Array<int> dofs;
   FiniteElementSpace::MarkerToList(marker, dofs);
   smoothed = Injection(*terms[0], dofs);
}

void FilteredAmg::SetHierarchy(std::unique_ptr<HypreParMatrix> alike_,
                               std::unique_ptr<HypreBoomerAMG> amg_)
{
   ClearHierarchy();
   alike = std::move(alike_);
   if (has_exact)
   {
      delete alike->EliminateRowsCols(exact);
      // It leaves zeros, and sweeps take as long over them: up to two thirds of
      // all entries.
      constexpr real_t zero = 1e-20;
      alike->DropSmallEntries(zero);
   }
   amg = std::move(amg_);
   selected.reset();
   amg->SetPrintLevel(0);
   amg->SetOperator(*alike);
   // hypre sets up at the first use: now, while it can be timed as set-up.
   residual = 0.0;
   Vector nothing(height);
   amg->Mult(residual, nothing);
   bytes_of_cycle = BytesOfCycle(*amg);
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
   FiniteElementSpace::MarkerToList(marker, contact_dofs);
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
   const std::unique_ptr<HypreParMatrix> columns = Columns(*injection);
   const std::unique_ptr<HypreParMatrix> restriction(injection->Transpose());
   std::unique_ptr<HypreParMatrix> matrix(
      ParMult(restriction.get(), columns.get(), true));
   const std::unique_ptr<HypreParMatrix> picks(smoothed->Transpose());
   const std::unique_ptr<HypreParMatrix> picked(
      ParMult(picks.get(), columns.get(), true));
   smoothed_columns.reset(ParMult(smoothed.get(), picked.get(), true));
   std::vector<PenalizedSolver::Factor> small_factors;
   for (const Factor &factor : factors)
   {
      const bool one = factor.changes == factor.forces;
      small_factors.emplace_back();
      small_factors.back().forces.reset(
         ParMult(factor.forces, injection.get(), true));
      small_factors.back().changes.reset(
         one ? nullptr : ParMult(factor.changes, injection.get(), true));
   }
   in_contact.SetMatrices(std::move(matrix), std::move(small_factors));
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

void FilteredAmg::SetWeights(const std::vector<Vector> &weights,
                             const std::vector<Vector> &in_hierarchy,
                             WorkCounts &work)
{
   if (Select(Needed(weights, in_hierarchy)))
   {
      Restrict();
   }
   if (has_contact)
   {
      in_contact.SetHeld(HeldInContact());
      in_contact.SetWeights(weights, work);
   }
}

Array<int> FilteredAmg::HeldInContact() const
{
   Array<int> places;
   for (const int dof : OnHost(held))
   {
      const int place = contact_dofs.FindSorted(dof);
      MFEM_VERIFY(place >= 0 || prescribed.FindSorted(dof) >= 0,
                  "a held dof is not one that contact touches");
      if (place >= 0)
      {
         places.Append(place);
      }
   }
   return places;
}

void FilteredAmg::Cycle(const Vector &x, Vector &y) const
{
   const ProfiledWork work("cycle", bytes_of_cycle);
   amg->Mult(x, y);
}

void FilteredAmg::RemoveContact(const Vector &x) const
{
   const ProfiledWork work("residual", BytesOf(smoothed_columns.get()));
   residual = x;
   smoothed_columns->Mult(-1.0, first, 1.0, residual);
   small_residual = 0.0;
   in_contact.AddPenalties(-1.0, first, small_residual);
   residual.AddElementVector(contact_dofs, small_residual);
   residual.SetSubVector(exact, 0.0);
   residual.SetSubVector(held, 0.0);
}

void FilteredAmg::CorrectContact(const Vector &y) const
{
   {
      const ProfiledWork work("residual", BytesOf(smoothed_columns.get()));
      y.GetSubVector(contact_dofs, small_correction);
      smoothed_columns->MultTranspose(-1.0, y, 0.0, small_residual);
      in_contact.AddPenalties(-1.0, small_correction, small_residual);
   }
   in_contact.Mult(small_residual, small_correction);
   first += small_correction;
}

void FilteredAmg::Mult(const Vector &x, Vector &y) const
{
   if (!has_contact)
   {
      Cycle(x, y);
      return;
   }
   x.GetSubVector(contact_dofs, small_residual);
   in_contact.Mult(small_residual, first);
   RemoveContact(x);
   Cycle(residual, y);
   y.SetSubVector(held, 0.0);
   if (filter == Filter::around)
   {
      CorrectContact(y);
   }
   y.AddElementVector(contact_dofs, first);
   CopyEntries(held, x, y);
}

} // namespace synovia
