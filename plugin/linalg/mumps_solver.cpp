#include "synovia/linalg/mumps_solver.hpp"

#ifdef MFEM_USE_MUMPS

#include "synovia/general/profiled_work.hpp"
#include "synovia/general/reduce.hpp"
#include "synovia/linalg/coupled_rows.hpp"
#include "synovia/linalg/mumps_instance.hpp"
#include "synovia/linalg/pattern_hash.hpp"

#include <algorithm>
#include <utility>

namespace synovia
{

using namespace mfem;

namespace
{
/// This rank's rows but for lone unknowns, only the lower triangle of symmetric
/// ones, in MUMPS' numbers.
template <typename Number>
struct Entries
{
   Entries(const SparseMatrix &mine, int first, const Array<int> &others,
           const LoneUnknowns &lone, bool lower_triangle)
   {
      rows.reserve(mine.NumNonZeroElems());
      columns.reserve(mine.NumNonZeroElems());
      values.reserve(mine.NumNonZeroElems());
      for (const int i : others)
      {
         const int row = lone.NumberOfOther(first + i);
         for (int k = mine.GetI()[i]; k < mine.GetI()[i + 1]; k++)
         {
            const int column = mine.GetJ()[k];
            if (!lower_triangle || column <= first + i)
            {
               rows.push_back(row + 1);
               columns.push_back(lone.NumberOfOther(column) + 1);
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
   rows = matrix.GetGlobalNumRows();
   route.reset();

   CoupledMatrix coupled =
      CoupledRows(matrix, KeepsOrdering() ? DroppedZeros::of_lone_unknowns
                                          : DroppedZeros::all);
   lone = std::move(coupled.lone);
   Part(coupled.rows);
   const std::uint64_t now = PatternHash(coupled.rows).Value();
   // A zero on the diagonal makes an unknown no lone one, in the same pattern.
   const bool reorder = AnyRank(
      !instance || now != pattern || instance->data.n != CountOfOthers(), comm);
   pattern = now;
   if (reorder)
   {
      instance.reset();
      if (CountOfOthers() == 0)
      {
         return;
      }
      instance = std::make_unique<MumpsInstance<Number>>(comm, kind, options);
      instance->WorkspaceMargin() = workspace_margin;
   }
   Entries<Number> entries(coupled.rows, static_cast<int>(first_row),
                           others_here, *lone, kind != MatrixKind::general);
   instance->data.n = CountOfOthers();
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
   right_side_rows.clear();
   for (const int row : others_here)
   {
      right_side_rows.push_back(
         lone->NumberOfOther(static_cast<int>(first_row) + row) + 1);
   }
   solution_rows.resize(instance->SolutionSize());
}

template <typename Number>
void MumpsSolver<Number>::Part(const SparseMatrix &coupled)
{
   const int first = static_cast<int>(first_row);
   others_here.SetSize(0);
   lone_here.SetSize(0);
   for (int i = 0; i < height; i++)
   {
      (lone->Has(first + i) ? lone_here : others_here).Append(i);
   }
   lone_inverse.SetSize(lone_here.Size());
   for (int i = 0; i < lone_here.Size(); i++)
   {
      // Nothing else is there.
      lone_inverse[i] = 1.0 / coupled.GetData()[coupled.GetI()[lone_here[i]]];
   }
}

template <typename Number>
int MumpsSolver<Number>::CountOfOthers() const
{
   return static_cast<int>(rows) - static_cast<int>(lone->Rows().size());
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
   const std::vector<int> others = lone->Others(static_cast<int>(rows));
   if (ordering.size == rows && options.compression == 0.0)
   {
      std::vector<int> positions = Positions(others);
      if (!instance->AnalyzeWith(positions))
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
   const std::vector<int> positions = instance->Positions();
   ordering.rows.resize(positions.size());
   for (std::size_t i = 0; i < positions.size(); i++)
   {
      ordering.rows[positions[i] - 1] = others[i];
   }
   ordering.operations = instance->Operations();
   ordering.size = rows;
   return true;
}

template <typename Number>
std::vector<int>
MumpsSolver<Number>::Positions(const std::vector<int> &others) const
{
   std::vector<char> had(rows, 0);
   for (const int row : ordering.rows)
   {
      had[row] = 1;
   }
   std::vector<int> positions(others.size());
   int next = 1;
   for (std::size_t i = 0; i < others.size(); i++)
   {
      if (!had[others[i]])
      {
         positions[i] = next++;
      }
   }
   for (const int row : ordering.rows)
   {
      if (!lone->Has(row))
      {
         positions[lone->NumberOfOther(row)] = next++;
      }
   }
   return positions;
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
   lone.reset();
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
   MFEM_VERIFY(lone, "there is no factorization");
   for (int i = 0; i < x.Size(); i++)
   {
      SolveLone(*x[i], *y[i]);
   }
   if (!instance)
   {
      return;
   }
   const ProfiledWork work("solve", instance->BytesOfSolve());
   const int count = x.Size();
   const int rows_here = others_here.Size();
   std::vector<Number> right_sides;
   right_sides.reserve(std::size_t(count) * rows_here);
   for (const Vector *one : x)
   {
      for (const int row : others_here)
      {
         right_sides.push_back(static_cast<Number>((*one)[row]));
      }
   }
   const int solution_size = static_cast<int>(solution_rows.size());
   std::vector<Number> solutions(std::size_t(count) * solution_size);

   auto &data = instance->data;
   data.nrhs = count;
   data.nloc_rhs = data.lrhs_loc = rows_here;
   data.irhs_loc = const_cast<int *>(right_side_rows.data());
   data.rhs_loc = right_sides.data();
   data.lsol_loc = solution_size;
   data.isol_loc = solution_rows.data();
   data.sol_loc = solutions.data();
   if (!instance->Run(MumpsJob::solve))
   {
      throw FactorizationError(instance->Explain("solve for a right side"));
   }

   if (!route)
   {
      std::vector<HYPRE_BigInt> solved;
      for (const int row : solution_rows)
      {
         solved.push_back(row - 1);
      }
      route = std::make_unique<RowRoute>(
         solved, lone->NumberOfOther(static_cast<int>(first_row)), comm);
   }
   Vector solution(solution_size);
   Vector brought(rows_here);
   for (int i = 0; i < count; i++)
   {
      std::copy_n(solutions.begin() + std::size_t(i) * solution_size,
                  solution_size, solution.begin());
      route->Bring(solution.HostRead(), brought);
      y[i]->SetSubVector(others_here, brought);
   }
}

template <typename Number>
void MumpsSolver<Number>::SolveLone(const Vector &x, Vector &y) const
{
   x.HostRead();
   y.HostWrite();
   for (int i = 0; i < lone_here.Size(); i++)
   {
      y[lone_here[i]] = lone_inverse[i] * x[lone_here[i]];
   }
}

template class MumpsSolver<double>;
#ifdef SYNOVIA_USE_SINGLE_MUMPS
template class MumpsSolver<float>;
#endif

} // namespace synovia

#endif
