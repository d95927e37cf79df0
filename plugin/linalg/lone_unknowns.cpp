#include "synovia/linalg/lone_unknowns.hpp"
#include "synovia/general/gather_on_all.hpp"
#include "synovia/general/reduce.hpp"

#include <algorithm>
#include <iterator>

namespace synovia
{

using namespace mfem;

namespace
{
/// Whether a row has nothing but its entry on the diagonal, and that.
bool HasOnlyDiagonal(const SparseMatrix &rows, int row, int diagonal)
{
   bool has_diagonal = false;
   for (int k = rows.GetI()[row]; k < rows.GetI()[row + 1]; k++)
   {
      if (rows.GetData()[k] != 0.0)
      {
         if (rows.GetJ()[k] != diagonal)
         {
            return false;
         }
         has_diagonal = true;
      }
   }
   return has_diagonal;
}

std::vector<int> FindDiagonalRows(const SparseMatrix &rows, int first,
                                  MPI_Comm comm)
{
   std::vector<int> mine;
   for (int i = 0; i < rows.Height(); i++)
   {
      if (HasOnlyDiagonal(rows, i, first + i))
      {
         mine.push_back(first + i);
      }
   }
   return GatherOnAll(mine, comm);
}

/// Of the @a candidates, ascending, those in whose columns other rows have
/// entries.
std::vector<int> FindUsed(const SparseMatrix &rows, int first,
                          const std::vector<int> &candidates, MPI_Comm comm)
{
   const auto is_candidate = [&](int column)
   { return std::binary_search(candidates.begin(), candidates.end(), column); };
   std::vector<char> here(rows.Height());
   for (int i = 0; i < rows.Height(); i++)
   {
      here[i] = is_candidate(first + i);
   }
   std::vector<int> used;
   for (int i = 0; i < rows.Height(); i++)
   {
      for (int k = rows.GetI()[i]; k < rows.GetI()[i + 1]; k++)
      {
         const int column = rows.GetJ()[k];
         const int place = column - first;
         if (place != i && rows.GetData()[k] != 0.0 &&
             (place >= 0 && place < rows.Height() ? here[place] != 0
                                                  : is_candidate(column)))
         {
            used.push_back(column);
         }
      }
   }
   if (!AnyRank(!used.empty(), comm))
   {
      return used;
   }
   used = GatherOnAll(used, comm);
   std::sort(used.begin(), used.end());
   return used;
}
} // namespace

LoneUnknowns::LoneUnknowns(const SparseMatrix &rows, int first_, MPI_Comm comm)
   : first(first_)
{
   const std::vector<int> diagonal = FindDiagonalRows(rows, first, comm);
   const std::vector<int> used = FindUsed(rows, first, diagonal, comm);
   std::set_difference(diagonal.begin(), diagonal.end(), used.begin(),
                       used.end(), std::back_inserter(lone));
   for (int i = 0; i < rows.Height(); i++)
   {
      before.push_back(Before(first + i));
   }
}

bool LoneUnknowns::Has(int row) const
{
   return std::binary_search(lone.begin(), lone.end(), row);
}

int LoneUnknowns::Before(int row) const
{
   return static_cast<int>(std::lower_bound(lone.begin(), lone.end(), row) -
                           lone.begin());
}

int LoneUnknowns::NumberOfOther(int row) const
{
   const int here = row - first;
   return row - (here >= 0 && here < static_cast<int>(before.size())
                    ? before[here]
                    : Before(row));
}

std::vector<int> LoneUnknowns::Others(int rows) const
{
   std::vector<int> others;
   auto next = lone.begin();
   for (int row = 0; row < rows; row++)
   {
      if (next != lone.end() && *next == row)
      {
         ++next;
      }
      else
      {
         others.push_back(row);
      }
   }
   return others;
}

} // namespace synovia
