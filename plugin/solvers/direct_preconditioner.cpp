#include "solvers/direct_preconditioner.hpp"
#include "contact/exchange.hpp"
#include "general/reduce.hpp"
#include "solvers/direct_solver.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace synovia
{

using namespace mfem;

namespace
{
// Steps within this factor of the one factorised for still share its factors.
constexpr real_t like_step = 1.2;
// A weight that differs by more than this part is another one.
constexpr real_t other_weight = 0.5;
// A column that differs by less than this part is taken for the one solved for.
constexpr real_t like_column = 1e-2;

bool Differs(real_t a, real_t b)
{
   return std::abs(a - b) > other_weight * std::max(a, b);
}
} // namespace

DirectPreconditioner::DirectPreconditioner(const BiphasicJacobian &jacobian_,
                                           MPI_Comm comm_, int renew_after_)
   : BiphasicPreconditioner(jacobian_.Height()), jacobian(jacobian_),
     comm(comm_), renew_after(renew_after_), update(comm)
{
}

bool DirectPreconditioner::IsLikeFactorised() const
{
   const real_t now = jacobian.TimeStep();
   return now <= like_step * dt && dt <= like_step * now;
}

std::vector<DirectPreconditioner::Change>
DirectPreconditioner::FindChanges() const
{
   std::vector<Change> mine;
   const auto compare = [&](const Vector &now, const Vector &then,
                            const HypreParMatrix &rows, Kind kind, size_t pair)
   {
      for (int j = 0; j < now.Size(); j++)
      {
         if (Differs(now[j], then[j]))
         {
            mine.push_back({kind, static_cast<int>(pair), rows.RowPart()[0] + j,
                            now[j] - then[j]});
         }
      }
   };
   for (size_t i = 0; i < jacobian.Pairs().size(); i++)
   {
      const ContactPair &pair = *jacobian.Pairs()[i];
      compare(pair.GapWeights(), gap_weights[i], jacobian.Gap(i), gap_row, i);
      compare(pair.JumpWeights(), jump_weights[i], *pair.Operators().jump,
              jump_row, i);
   }
   const HYPRE_BigInt first = jacobian.Volume().darcy->RowPart()[0];
   const auto add_missing =
      [&](const Array<int> &from, const Array<int> &in, Kind kind)
   {
      for (const int dof : from)
      {
         if (in.FindSorted(dof) < 0)
         {
            mine.push_back({kind, 0, first + dof, 0.0});
         }
      }
   };
   add_missing(jacobian.PressureDofs(), p_dofs, drained);
   add_missing(p_dofs, jacobian.PressureDofs(), sealed);

   int ranks = 1;
   MPI_Comm_size(comm, &ranks);
   std::vector<Change> all;
   for (const auto &part :
        Exchange(std::vector<std::vector<Change>>(ranks, mine), comm))
   {
      all.insert(all.end(), part.begin(), part.end());
   }
   std::sort(all.begin(), all.end(),
             [](const Change &a, const Change &b) {
                return std::tie(a.kind, a.pair, a.row) <
                       std::tie(b.kind, b.pair, b.row);
             });
   return all;
}

void DirectPreconditioner::Update()
{
   fresh = outdated || !IsLikeFactorised() || !Follow(FindChanges());
   if (fresh)
   {
      Factorise();
   }
}

void DirectPreconditioner::Factorise()
{
   dt = jacobian.TimeStep();
   p_dofs = jacobian.PressureDofs();
   gap_weights.clear();
   jump_weights.clear();
   for (const ContactPair *pair : jacobian.Pairs())
   {
      gap_weights.push_back(pair->GapWeights());
      jump_weights.push_back(pair->JumpWeights());
   }
   outdated = false;
   extra_solves = 0;
   update.Set({}, DenseMatrix());
   columns.clear();
   // The old factors go first: two at once would double the peak of memory.
   factors.reset();
   matrix = jacobian.Assemble();
   factors = MakeDirectSolver(*matrix, MatrixKind::symmetric);
}

Vector DirectPreconditioner::UnitPressure(HYPRE_BigInt dof) const
{
   const HYPRE_BigInt *part = jacobian.Volume().darcy->RowPart();
   Vector unit(height);
   unit = 0.0;
   if (dof >= part[0] && dof < part[1])
   {
      unit[jacobian.Offsets()[1] + static_cast<int>(dof - part[0])] = 1.0;
   }
   return unit;
}

real_t DirectPreconditioner::Entry(const Vector &x, HYPRE_BigInt dof) const
{
   return SumOverRanks(UnitPressure(dof) * x, comm);
}

Vector DirectPreconditioner::RowOf(const Change &change) const
{
   const bool is_gap = change.kind == gap_row;
   const HypreParMatrix &rows =
      is_gap ? jacobian.Gap(change.pair)
             : *jacobian.Pairs()[change.pair]->Operators().jump;
   Vector unit(rows.Height());
   unit = 0.0;
   const HYPRE_BigInt *part = rows.RowPart();
   if (change.row >= part[0] && change.row < part[1])
   {
      unit[static_cast<int>(change.row - part[0])] = 1.0;
   }
   Vector row(height);
   row = 0.0;
   const int begin = jacobian.Offsets()[is_gap ? 0 : 1];
   Vector block(row, begin, rows.Width());
   rows.MultTranspose(unit, block);
   if (is_gap)
   {
      block.SetSubVector(jacobian.DisplacementDofs(), 0.0);
   }
   else
   {
      block.SetSubVector(p_dofs, 0.0);
      block.SetSubVector(jacobian.PressureDofs(), 0.0);
   }
   return row;
}

// With F the dofs that are free both then and now, the matrix changes on F x F
// by the rows with other weights. A pressure i that was free has the row A_f
// e_i, which drains to a unit row; one that was drained gets that of the
// present matrix. With a_i its part on F, both are a_i e_i^T + e_i a_i^T and
// what is on the dofs that switch alone.
bool DirectPreconditioner::Follow(const std::vector<Change> &changes)
{
   // So many changes are cheaper to factorise.
   if (static_cast<int>(changes.size()) > 2 * renew_after)
   {
      return false;
   }
   std::vector<Key> keys;
   std::vector<Vector> wanted;
   std::vector<size_t> switched;
   std::vector<Vector> switched_rows;
   for (const Change &change : changes)
   {
      const Key key{{change.kind, change.pair, change.row, 0}};
      keys.push_back(key);
      if (change.kind == gap_row || change.kind == jump_row)
      {
         wanted.push_back(RowOf(change));
         continue;
      }
      const Vector unit = UnitPressure(change.row);
      Vector row(height);
      if (change.kind == drained)
      {
         matrix->Mult(unit, row);
         row.Neg();
      }
      else
      {
         jacobian.Mult(unit, row);
      }
      switched.push_back(wanted.size());
      wanted.push_back(unit);
      switched_rows.push_back(row);
   }
   const size_t units_end = wanted.size();
   DenseMatrix k(static_cast<int>(units_end + switched.size()));
   k = 0.0;
   for (size_t i = 0; i < units_end; i++)
   {
      const Change &change = changes[i];
      if (change.kind == gap_row)
      {
         k(i, i) = change.weight;
      }
      else if (change.kind == jump_row)
      {
         k(i, i) = -jacobian.TimeStep() * change.weight;
      }
   }
   for (size_t s = 0; s < switched.size(); s++)
   {
      const size_t i = switched[s];
      const size_t a = units_end + s;
      Vector row(switched_rows[s]);
      for (const size_t other : switched)
      {
         if (changes[other].kind == changes[i].kind)
         {
            k(i, other) = Entry(switched_rows[s], changes[other].row);
         }
         row.Add(-Entry(row, changes[other].row),
                 UnitPressure(changes[other].row));
      }
      // Prescribed pressures have -1 on the diagonal.
      k(i, i) += changes[i].kind == drained ? -1.0 : 1.0;
      k(i, a) = k(a, i) = 1.0;
      Key key = keys[i];
      key[3] = 1;
      keys.push_back(key);
      wanted.push_back(row);
   }

   std::vector<bool> known(keys.size(), false);
   int missing = 0;
   for (size_t i = 0; i < keys.size(); i++)
   {
      const auto found = columns.find(keys[i]);
      if (found != columns.end())
      {
         Vector difference(found->second.w);
         difference -= wanted[i];
         known[i] = InnerProduct(comm, difference, difference) <=
                    like_column * like_column *
                       InnerProduct(comm, wanted[i], wanted[i]);
      }
      missing += known[i] ? 0 : 1;
   }
   if (missing > renew_after)
   {
      return false;
   }
   std::vector<const LowRankUpdate::Column *> used;
   for (size_t i = 0; i < keys.size(); i++)
   {
      LowRankUpdate::Column &column = columns[keys[i]];
      if (!known[i])
      {
         column.w = wanted[i];
         column.z.SetSize(height);
         factors->Mult(column.w, column.z);
         extra_solves++;
      }
      used.push_back(&column);
   }
   update.Set(used, k);
   return true;
}

bool DirectPreconditioner::Report(int iterations, bool converged)
{
   extra_solves += std::max(0, iterations - 1);
   outdated = extra_solves >= renew_after;
   return !converged && !fresh;
}

void DirectPreconditioner::Mult(const Vector &x, Vector &y) const
{
   factors->Mult(x, y);
   update.Correct(y);
}

} // namespace synovia
