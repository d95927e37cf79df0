#include "synovia/linalg/mumps_solver.hpp"

#ifdef MFEM_USE_MUMPS

#include "synovia/general/profiled_work.hpp"
#include "synovia/general/reduce.hpp"
#include "synovia/linalg/coupled_rows.hpp"
#include "synovia/linalg/mumps_instance.hpp"
#include "synovia/linalg/pattern_hash.hpp"

#include <algorithm>
#include <numeric>

namespace synovia
{

using namespace mfem;

namespace
{
/// Rows from @a first on, only the lower triangle of symmetric ones, in global
/// numbers from 1.
template <typename Number>
struct Entries
{
   Entries(const SparseMatrix &mine, int first, bool lower_triangle)
   {
      rows.reserve(mine.NumNonZeroElems());
      columns.reserve(mine.NumNonZeroElems());
      values.reserve(mine.NumNonZeroElems());
      for (int i = 0; i < mine.Height(); i++)
      {
         for (int k = mine.GetI()[i]; k < mine.GetI()[i + 1]; k++)
         {
            const int column = mine.GetJ()[k];
            if (!lower_triangle || column <= first + i)
            {
               rows.push_back(first + i + 1);
               columns.push_back(column + 1);
               values.push_back(static_cast<Number>(mine.GetData()[k]));
            }
         }
      }
   }

   std::vector<int> rows;
   std::vector<int> columns;
   std::vector<Number> values;
};
} // namespace

template <typename Number>
MumpsSolver<Number>::MumpsSolver(MPI_Comm comm_, MatrixKind kind_,
                                 const DirectOptions &options_)
   : comm(comm_), kind(kind_), options(options_)
{
}

template <typename Number>
MumpsSolver<Number>::~MumpsSolver() = default;

template <typename Number>
void MumpsSolver<Number>::SetOperator(const Operator &op)
{
   const auto &matrix = dynamic_cast<const HypreParMatrix &>(op);
   height = width = matrix.Height();
   first_row = matrix.RowPart()[0];
   route.reset();

   const SparseMatrix coupled =
      CoupledRows(matrix, KeepsOrdering() ? DroppedZeros::of_lone_unknowns
                                          : DroppedZeros::all);
   const std::uint64_t now = PatternHash(coupled).Value();
   const bool reorder = AnyRank(!instance || now != pattern, comm);
   pattern = now;
   if (reorder)
   {
      instance.reset();
      instance = std::make_unique<MumpsInstance<Number>>(comm, kind, options);
      instance->WorkspaceMargin() = workspace_margin;
   }
   Entries<Number> entries(coupled, static_cast<int>(first_row),
                           kind != MatrixKind::general);
   instance->data.n = static_cast<int>(matrix.GetGlobalNumRows());
   instance->data.nnz_loc = static_cast<MUMPS_INT8>(entries.values.size());
   instance->data.irn_loc = entries.rows.data();
   instance->data.jcn_loc = entries.columns.data();
   instance->data.a_loc = entries.values.data();
   if (reorder && !Analyze())
   {
      Fail("order the matrix");
   }
   if (!Factorize())
   {
      Fail("factorize the matrix");
   }
   right_side_rows.resize(height);
   std::iota(right_side_rows.begin(), right_side_rows.end(),
             static_cast<int>(first_row) + 1);
   solution_rows.resize(instance->SolutionSize());
}

template <typename Number>
bool MumpsSolver<Number>::KeepsOrdering() const
{
   // Where contact slides on, patterns differ little, and an ordering takes
   // longer than what a slightly worse one costs, unless blocks of low rank are
   // made of it: those of a kept one take up to half as long again. Operators
   // of symmetric contact stay as they are.
   return options.compression == 0.0 || kind != MatrixKind::general;
}

template <typename Number>
bool MumpsSolver<Number>::Analyze()
{
   constexpr double most_growth = 1.3;
   const int rows = instance->data.n;
   if (ordering.rows == rows && options.compression == 0.0)
   {
      if (!instance->AnalyzeWith(ordering.positions))
      {
         return false;
      }
      if (instance->Operations() <= most_growth * ordering.operations)
      {
         return true;
      }
   }
   if (!instance->Analyze())
   {
      return false;
   }
   ordering = {instance->Positions(), instance->Operations(), rows};
   return true;
}

template <typename Number>
bool MumpsSolver<Number>::Factorize()
{
   // Pivots that can't be taken in the order foreseen cost workspace; within a
   // limit MUMPS takes all there is.
   constexpr int most_margin = 160;
   while (!instance->Run(MumpsJob::factorize))
   {
      const MumpsStatus why = instance->Status();
      const bool margin_helps =
         why == MumpsStatus::small_index_workspace ||
         why == MumpsStatus::small_send_buffer ||
         why == MumpsStatus::small_receive_buffer ||
         (why == MumpsStatus::small_workspace && options.memory_limit == 0);
      if (!margin_helps || workspace_margin >= most_margin)
      {
         return false;
      }
      workspace_margin *= 2;
      instance->WorkspaceMargin() = workspace_margin;
   }
   return true;
}

template <typename Number>
void MumpsSolver<Number>::Fail(const std::string &task)
{
   const std::string reason = instance->Explain(task);
   instance.reset();
   throw FactorizationError(reason);
}

template <typename Number>
void MumpsSolver<Number>::Mult(const Vector &x, Vector &y) const
{
   Array<const Vector *> right_sides({&x});
   Array<Vector *> solutions({&y});
   ArrayMult(right_sides, solutions);
}

template <typename Number>
void MumpsSolver<Number>::ArrayMult(const Array<const Vector *> &x,
                                    Array<Vector *> &y) const
{
   MFEM_VERIFY(instance, "there is no factorization");
   const ProfiledWork work("solve", instance->BytesOfSolve());
   const int count = x.Size();
   std::vector<Number> right_sides;
   right_sides.reserve(std::size_t(count) * height);
   for (const Vector *one : x)
   {
      one->HostRead();
      right_sides.insert(right_sides.end(), one->begin(), one->end());
   }
   const int rows_here = static_cast<int>(solution_rows.size());
   std::vector<Number> solutions(std::size_t(count) * rows_here);

   auto &data = instance->data;
   data.nrhs = count;
   data.nloc_rhs = data.lrhs_loc = height;
   data.irhs_loc = const_cast<int *>(right_side_rows.data());
   data.rhs_loc = right_sides.data();
   data.lsol_loc = rows_here;
   data.isol_loc = solution_rows.data();
   data.sol_loc = solutions.data();
   if (!instance->Run(MumpsJob::solve))
   {
      throw FactorizationError(instance->Explain("solve for a right side"));
   }

   if (!route)
   {
      std::vector<HYPRE_BigInt> rows;
      for (const int row : solution_rows)
      {
         rows.push_back(row - 1);
      }
      route = std::make_unique<RowRoute>(rows, first_row, comm);
   }
   Vector here(rows_here);
   for (int i = 0; i < count; i++)
   {
      std::copy_n(solutions.begin() + std::size_t(i) * rows_here, rows_here,
                  here.begin());
      route->Bring(here.HostRead(), *y[i]);
   }
}

template class MumpsSolver<double>;
#ifdef SYNOVIA_USE_SINGLE_MUMPS
template class MumpsSolver<float>;
#endif

} // namespace synovia

#endif
