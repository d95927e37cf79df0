#include "synovia/linalg/direct_preconditioner.hpp"
#include "synovia/general/gather_on_all.hpp"
#include "synovia/general/reduce.hpp"
#include "synovia/linalg/direct_solver.hpp"

#include <algorithm>
#include <cmath>

namespace synovia
{

using namespace mfem;

namespace
{
// Of parts of vectors a and b, adds |a - b|^2 and |b|^2 to @a squares.
void AddDistance(const SparsePart &a, const SparsePart &b,
                 std::array<real_t, 2> &squares)
{
   std::map<int, real_t> difference;
   for (std::size_t i = 0; i < a.dofs.size(); i++)
   {
      difference[a.dofs[i]] += a.entries[i];
   }
   for (std::size_t i = 0; i < b.dofs.size(); i++)
   {
      difference[b.dofs[i]] -= b.entries[i];
      squares[1] += b.entries[i] * b.entries[i];
   }
   for (const auto &entry : difference)
   {
      squares[0] += entry.second * entry.second;
   }
}

// Global rows x local columns.
std::unique_ptr<SparseMatrix> RowTable(const HypreParMatrix &matrix)
{
   const std::unique_ptr<HypreParMatrix> transpose(matrix.Transpose());
   SparseMatrix mine;
   transpose->MergeDiagAndOffd(mine);
   return std::unique_ptr<SparseMatrix>(Transpose(mine));
}

std::array<real_t, 2> Distance(const LowRankUpdate::Column &a,
                               const LowRankUpdate::Column &b)
{
   std::array<real_t, 2> squares{{0.0, 0.0}};
   AddDistance(a.left, b.left, squares);
   AddDistance(a.right, b.right, squares);
   return squares;
}
} // namespace

DirectPreconditioner::DirectPreconditioner(const BiphasicJacobian &jacobian_,
                                           MPI_Comm comm_, int renew_after_,
                                           const DirectOptions &options_,
                                           const FactorizationTuning &tuning_)
   : BiphasicPreconditioner(jacobian_.Height()), jacobian(jacobian_),
     comm(comm_), renew_after(renew_after_), options(options_), tuning(tuning_),
     update(comm)
{
}

real_t DirectPreconditioner::MostColumns(int renew_after,
                                         const FactorizationTuning &tuning)
{
   return renew_after / tuning.column_cost;
}

void DirectPreconditioner::ContactMoved()
{
   TangentChanged();
   moved = true;
}

void DirectPreconditioner::TangentChanged()
{
   tables.clear();
   tie_map.reset();
}

bool DirectPreconditioner::IsLikeFactorized() const
{
   const real_t now = jacobian.TimeStep();
   return now <= tuning.like_step * dt && dt <= tuning.like_step * now;
}

std::vector<DirectPreconditioner::Change>
DirectPreconditioner::FindChanges() const
{
   std::vector<Change> mine;
   const auto differs = [this](real_t a, real_t b)
   { return std::abs(a - b) > tuning.other_weight * std::max(a, b); };
   const auto compare = [&](const Vector &now, const Vector &then, real_t scale,
                            const HypreParMatrix &operator_, Kind kind,
                            size_t pair)
   {
      for (int j = 0; j < now.Size(); j++)
      {
         if (differs(now[j], then[j]))
         {
            mine.push_back({{{kind, static_cast<HYPRE_BigInt>(pair),
                              operator_.RowPart()[0] + j}},
                            scale * (now[j] - then[j])});
         }
      }
   };
   for (size_t i = 0; i < jacobian.Contact().size(); i++)
   {
      const ContactFactors &pair = jacobian.Contact()[i];
      compare(*pair.gap_weights, gap_weights[i], 1.0, *pair.gap, gap_row, i);
      compare(*pair.jump_weights, jump_weights[i], -jacobian.TimeStep(),
              *pair.jump, jump_row, i);
   }
   const HYPRE_BigInt first = jacobian.Volume().darcy->RowPart()[0];
   const auto add_missing =
      [&](const Array<int> &from, const Array<int> &in, real_t sign)
   {
      for (const int dof : from)
      {
         if (in.FindSorted(dof) < 0)
         {
            mine.push_back(
               {{{held_pressure, 0, first + dof}}, sign * holding[dof]});
         }
      }
   };
   add_missing(jacobian.PressureDofs(), OnHost(p_dofs), -1.0);
   add_missing(p_dofs, jacobian.PressureDofs(), 1.0);

   std::vector<Change> all = GatherOnAll(mine, comm);
   std::sort(all.begin(), all.end(),
             [](const Change &a, const Change &b) { return a.key < b.key; });
   return all;
}

void DirectPreconditioner::Update()
{
   fresh = outdated || !IsLikeFactorized() || !Follow(FindChanges());
   if (fresh)
   {
      Factorize();
   }
}

void DirectPreconditioner::ChooseAccuracy()
{
   // Symmetric factors take half the operations; small ones serve so many
   // systems that an iteration more in each costs more than a factorization.
   constexpr real_t symmetric_ratio = 3.0;
   const bool symmetric = jacobian.IsContactSymmetric();
   const real_t unknowns = SumOverRanks(height, comm);
   options.single_precision = tuning.single_precision &&
                              (!symmetric || unknowns > tuning.compress_above);
   if (unknowns > (symmetric ? symmetric_ratio : 1.0) * tuning.compress_above)
   {
      options.compression = tuning.compression;
   }
}

void DirectPreconditioner::Factorize()
{
   dt = jacobian.TimeStep();
   p_dofs = jacobian.PressureDofs();
   gap_weights.clear();
   jump_weights.clear();
   for (const ContactFactors &pair : jacobian.Contact())
   {
      gap_weights.push_back(*pair.gap_weights);
      jump_weights.push_back(*pair.jump_weights);
   }
   outdated = false;
   moved = false;
   extra_solves = 0.0;
   update.Set({}, Vector());
   columns.clear();
   if (!factors)
   {
      ChooseAccuracy();
   }
   // Large beside what contact adds to the diagonal, and small enough to be
   // taken back from the factors by a column.
   constexpr real_t of_double = 1e11;
   constexpr real_t of_single = 1e5;
   const real_t large = options.single_precision ? of_single : of_double;
   holding = jacobian.Holding(large);
   // As much as round-off of the factors leaves of a freedom.
   constexpr real_t above_round_off = 1e-2;
   const std::unique_ptr<HypreParMatrix> matrix =
      jacobian.AssembleHeld(holding, above_round_off / large);
   if (factors)
   {
      factors->SetOperator(*matrix);
   }
   else
   {
      factors =
         MakeDirectSolver(*matrix,
                          jacobian.IsContactSymmetric() ? MatrixKind::symmetric
                                                        : MatrixKind::general,
                          options);
   }
   work.factorizations++;
}

const SparseMatrix &DirectPreconditioner::Rows(const HypreParMatrix &matrix)
{
   std::unique_ptr<SparseMatrix> &table = tables[&matrix];
   if (!table)
   {
      table = RowTable(matrix);
   }
   return *table;
}

const SparseMatrix &
DirectPreconditioner::RowsOnFreedoms(const HypreParMatrix &matrix)
{
   if (!tie_map)
   {
      tie_map = jacobian.MakeTieMap();
   }
   std::unique_ptr<SparseMatrix> &table = tables[&matrix];
   if (!table)
   {
      table = RowTable(tie_map ? *tie_map->Columns(matrix) : matrix);
   }
   return *table;
}

void DirectPreconditioner::AddDisplacements(const HypreParMatrix &matrix,
                                            int row, SparsePart &part)
{
   const SparseMatrix &table = RowsOnFreedoms(matrix);
   for (int i = table.GetI()[row]; i < table.GetI()[row + 1]; i++)
   {
      const int dof = table.GetJ()[i];
      if (jacobian.PrescribedDofs().FindSorted(dof) < 0)
      {
         part.Add(dof, table.GetData()[i]);
      }
   }
}

void DirectPreconditioner::AddPressures(const HypreParMatrix &matrix, int row,
                                        SparsePart &part)
{
   const SparseMatrix &table = Rows(matrix);
   for (int i = table.GetI()[row]; i < table.GetI()[row + 1]; i++)
   {
      part.Add(jacobian.Offsets()[1] + table.GetJ()[i], table.GetData()[i]);
   }
}

DirectPreconditioner::Column DirectPreconditioner::ColumnOf(const Key &key)
{
   Column column;
   if (key[0] == held_pressure)
   {
      const HYPRE_BigInt *part = jacobian.Volume().darcy->RowPart();
      if (key[2] >= part[0] && key[2] < part[1])
      {
         column.left.Add(
            jacobian.Offsets()[1] + static_cast<int>(key[2] - part[0]), 1.0);
      }
      column.right = column.left;
      return column;
   }
   const ContactFactors &pair = jacobian.Contact()[key[1]];
   const int row = static_cast<int>(key[2]);
   if (key[0] == gap_row)
   {
      AddDisplacements(*pair.gap, row, column.left);
      AddDisplacements(*pair.gap_change, row, column.right);
   }
   else
   {
      AddPressures(*pair.jump, row, column.left);
      column.right = column.left;
      if (pair.jump_change)
      {
         AddDisplacements(*pair.jump_change, row, column.right);
      }
   }
   return column;
}

std::vector<DirectPreconditioner::Key>
DirectPreconditioner::FindMissing(const std::vector<Change> &changes)
{
   std::vector<std::array<real_t, 2>> distances;
   for (const Change &change : changes)
   {
      const auto found = columns.find(change.key);
      // A unit column has nothing that could differ.
      const bool checked =
         found != columns.end() && change.key[0] != held_pressure;
      distances.push_back(checked
                             ? Distance(found->second, ColumnOf(change.key))
                             : std::array<real_t, 2>{{0.0, 0.0}});
   }
   MPI_Allreduce(MPI_IN_PLACE, distances.data(),
                 2 * static_cast<int>(distances.size()),
                 MPITypeMap<real_t>::mpi_type, MPI_SUM, comm);
   const real_t like = tuning.like_column * tuning.like_column;
   std::vector<Key> missing;
   for (size_t i = 0; i < changes.size(); i++)
   {
      if (columns.count(changes[i].key) == 0 ||
          distances[i][0] > like * distances[i][1])
      {
         missing.push_back(changes[i].key);
      }
   }
   return missing;
}

void DirectPreconditioner::AddColumns(const std::vector<Key> &keys)
{
   const size_t batch = tuning.column_batch;
   for (size_t begin = 0; begin < keys.size(); begin += batch)
   {
      const size_t end = std::min(begin + batch, keys.size());
      std::vector<Column *> made;
      for (size_t i = begin; i < end; i++)
      {
         Column &column = columns[keys[i]];
         column = ColumnOf(keys[i]);
         made.push_back(&column);
      }
      LowRankUpdate::SolveFor(made, *factors);
   }
   extra_solves += tuning.column_cost * keys.size();
   work.columns += static_cast<int>(keys.size());
}

bool DirectPreconditioner::Follow(const std::vector<Change> &changes)
{
   if (changes.size() > static_cast<size_t>(tuning.max_columns))
   {
      return false;
   }
   const std::vector<Key> missing = FindMissing(changes);
   if (extra_solves + tuning.column_cost * missing.size() > renew_after)
   {
      return false;
   }
   AddColumns(missing);
   std::vector<const Column *> used;
   Vector weights(static_cast<int>(changes.size()));
   for (size_t i = 0; i < changes.size(); i++)
   {
      used.push_back(&columns[changes[i].key]);
      weights[static_cast<int>(i)] = changes[i].weight;
   }
   update.Set(used, weights);
   return true;
}

int DirectPreconditioner::Patience() const
{
   const int stale = moved ? tuning.moved_patience : tuning.stale_patience;
   return fresh ? renew_after
                : std::min(renew_after, stale + fresh_iterations - 1);
}

bool DirectPreconditioner::RefineFactors()
{
   // Blocks of low rank are the coarser approximation.
   if (options.compression > 0.0)
   {
      options.compression = 0.0;
      tuning.compression = 0.0;
   }
   else if (options.single_precision)
   {
      tuning.single_precision = false;
   }
   else
   {
      return false;
   }
   factors.reset();
   return true;
}

bool DirectPreconditioner::Report(const SolveAttempt &attempt)
{
   const real_t decades = std::max(1.0, -std::log10(attempt.reduction));
   if (fresh && attempt.converged)
   {
      fresh_iterations = std::max(1, attempt.iterations);
      fresh_decades = decades;
   }
   const real_t usual =
      std::max(1.0, fresh_iterations * decades / fresh_decades);
   extra_solves += std::max(0.0, attempt.iterations - usual);
   const bool too_coarse = !attempt.converged && fresh && RefineFactors();
   const bool again = !attempt.converged && (!fresh || too_coarse);
   outdated = again || extra_solves >= renew_after;
   return again;
}

void DirectPreconditioner::Mult(const Vector &x, Vector &y) const
{
   const int begin = jacobian.Offsets()[1];
   // Factors and their update are on the host.
   right_side = x;
   real_t *const entries = right_side.HostReadWrite();
   for (const int dof : jacobian.PressureDofs())
   {
      entries[begin + dof] = 0.0;
   }
   factors->Mult(right_side, y);
   update.Correct(y);
   const real_t *from = x.HostRead();
   real_t *const to = y.HostReadWrite();
   for (const int dof : jacobian.PressureDofs())
   {
      to[begin + dof] = from[begin + dof];
   }
}

} // namespace synovia
