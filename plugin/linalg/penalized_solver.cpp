#include "synovia/linalg/penalized_solver.hpp"
#include "synovia/general/gather_on_all.hpp"
#include "synovia/general/reduce.hpp"
#include "synovia/linalg/biphasic_jacobian.hpp"
#include "synovia/linalg/injection.hpp"
#include "synovia/linalg/local_rows.hpp"

#include <algorithm>

namespace synovia
{

using namespace mfem;

PenalizedSolver::PenalizedSolver(MatrixKind kind_,
                                 const DirectOptions &options_,
                                 int most_columns_)
   : kind(kind_), options(options_), most_columns(most_columns_)
{
}

void PenalizedSolver::SetOperator(const Operator &)
{
   MFEM_ABORT("the penalized solver takes its matrices apart");
}

void PenalizedSolver::SetMatrices(std::unique_ptr<HypreParMatrix> matrix_,
                                  std::vector<Factor> factors_)
{
   matrix = std::move(matrix_);
   factors = std::move(factors_);
   height = width = matrix->Height();
   outdated = true;
   // Of another kind, the sum needs other factors; an ordering that there is
   // may serve on.
   const bool was_symmetric = symmetric;
   symmetric = IsSymmetric();
   if (symmetric != was_symmetric)
   {
      factorization.reset();
   }
}

void PenalizedSolver::SetHeld(const Array<int> &dofs)
{
   outdated =
      AnyRank(outdated || !(OnHost(held) == OnHost(dofs)), matrix->GetComm());
   held = dofs;
}

bool PenalizedSolver::IsSymmetric() const
{
   return std::all_of(factors.begin(), factors.end(),
                      [](const Factor &factor) { return !factor.changes; });
}

void PenalizedSolver::SetWeights(const std::vector<Vector> &weights_,
                                 WorkCounts &work)
{
   weights = weights_;
   if (!outdated && Follow(work))
   {
      return;
   }
   try
   {
      Factorize();
   }
   catch (const FactorizationError &)
   {
      if (!RefineFactors())
      {
         throw;
      }
      Factorize();
   }
   work.factorizations++;
}

void PenalizedSolver::Factorize()
{
   update.reset();
   columns.clear();
   auto sum = std::make_unique<HypreParMatrix>(*matrix);
   for (size_t i = 0; i < factors.size(); i++)
   {
      AddTo(sum, WeightedProduct(*factors[i].forces, weights[i],
                                 factors[i].Changes()));
   }
   sum->EliminateBC(held, DIAG_ONE);
   if (factorization)
   {
      factorization->SetOperator(*sum);
   }
   else
   {
      factorization = MakeDirectSolver(
         *sum, symmetric ? kind : MatrixKind::general, options);
   }
   factorized = weights;
   outdated = false;
}

bool PenalizedSolver::RefineFactors()
{
   if (!options.single_precision)
   {
      return false;
   }
   options.single_precision = false;
   outdated = true;
   factorization.reset();
   return true;
}

bool PenalizedSolver::Improve()
{
   if (update)
   {
      outdated = true;
      return true;
   }
   return RefineFactors();
}

std::vector<PenalizedSolver::Change> PenalizedSolver::FindChanges() const
{
   std::vector<Change> mine;
   for (size_t i = 0; i < factors.size(); i++)
   {
      const HYPRE_BigInt first = factors[i].forces->RowPart()[0];
      for (int j = 0; j < weights[i].Size(); j++)
      {
         if (weights[i][j] != factorized[i][j])
         {
            mine.push_back({{{static_cast<HYPRE_BigInt>(i), first + j}},
                            weights[i][j] - factorized[i][j]});
         }
      }
   }
   return mine;
}

bool PenalizedSolver::Follow(WorkCounts &work)
{
   MPI_Comm comm = matrix->GetComm();
   const std::vector<Change> mine = FindChanges();
   if (SumOverRanks(static_cast<real_t>(mine.size()), comm) > most_columns)
   {
      return false;
   }
   std::vector<Change> changes = GatherOnAll(mine, comm);
   std::sort(changes.begin(), changes.end(),
             [](const Change &a, const Change &b) { return a.key < b.key; });
   std::vector<Key> missing;
   for (const Change &change : changes)
   {
      if (columns.count(change.key) == 0)
      {
         missing.push_back(change.key);
      }
   }
   if (columns.size() + missing.size() > static_cast<size_t>(most_columns))
   {
      return false;
   }
   update.reset();
   if (changes.empty())
   {
      return true;
   }
   AddColumns(missing);
   work.columns += static_cast<int>(missing.size());
   std::vector<const LowRankUpdate::Column *> used;
   Vector k(static_cast<int>(changes.size()));
   for (size_t i = 0; i < changes.size(); i++)
   {
      used.push_back(&columns[changes[i].key]);
      k[static_cast<int>(i)] = changes[i].weight;
   }
   update = std::make_unique<LowRankUpdate>(comm);
   update->Set(used, k);
   return true;
}

void PenalizedSolver::AddColumns(const std::vector<Key> &keys)
{
   if (keys.empty())
   {
      return;
   }
   using Column = LowRankUpdate::Column;
   auto begin = keys.begin();
   while (begin != keys.end())
   {
      const Factor &factor = factors[(*begin)[0]];
      const auto end =
         std::find_if(begin, keys.end(),
                      [&](const Key &key) { return key[0] != (*begin)[0]; });
      const std::vector<Key> of_factor(begin, end);
      PickRows(*factor.forces, of_factor, &Column::left);
      PickRows(factor.Changes(), of_factor, &Column::right);
      begin = end;
   }
   std::vector<Column *> made;
   for (const Key &key : keys)
   {
      made.push_back(&columns[key]);
   }
   LowRankUpdate::SolveFor(made, *factorization);
}

void PenalizedSolver::PickRows(const HypreParMatrix &factor,
                               const std::vector<Key> &keys,
                               SparsePart LowRankUpdate::Column::*member)
{
   const HYPRE_BigInt *part = factor.RowPart();
   Array<int> rows;
   for (const Key &key : keys)
   {
      if (key[1] >= part[0] && key[1] < part[1])
      {
         rows.Append(static_cast<int>(key[1] - part[0]));
      }
   }
   const std::unique_ptr<HypreParMatrix> picks(
      Injection(factor, rows)->Transpose());
   const std::unique_ptr<HypreParMatrix> picked(
      ParMult(picks.get(), &factor, true));
   const std::unique_ptr<HypreParMatrix> by_dof(picked->Transpose());
   // Keys ascend, as rows do over ranks: columns are in the order of keys.
   const SparseMatrix mine = LocalRows(*by_dof);
   for (int dof = 0; dof < mine.Height(); dof++)
   {
      if (held.FindSorted(dof) >= 0)
      {
         continue;
      }
      for (int k = mine.GetI()[dof]; k < mine.GetI()[dof + 1]; k++)
      {
         (columns[keys[mine.GetJ()[k]]].*member).Add(dof, mine.GetData()[k]);
      }
   }
}

void PenalizedSolver::AddPenalties(real_t scale, const Vector &x,
                                   Vector &y) const
{
   for (size_t i = 0; i < factors.size(); i++)
   {
      Vector rows(factors[i].forces->Height());
      factors[i].Changes().Mult(x, rows);
      rows *= weights[i];
      factors[i].forces->MultTranspose(scale, rows, 1.0, y);
   }
}

void PenalizedSolver::Mult(const Vector &x, Vector &y) const
{
   right_side = x;
   right_side.SetSubVector(held, 0.0);
   factorization->Mult(right_side, y);
   if (update)
   {
      update->Correct(y);
   }
}

} // namespace synovia
