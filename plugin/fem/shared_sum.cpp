#include "synovia/fem/shared_sum.hpp"
#include "synovia/general/exchange.hpp"

#include <algorithm>
#include <array>
#include <climits>
#include <cstdint>

namespace synovia
{

using namespace mfem;

namespace
{
/// Finds entries of a distributed matrix, row by row: the numbers of those of
/// the block on the diagonal, and then of those beside it.
class EntryPlaces
{
public:
   explicit EntryPlaces(const HypreParMatrix &matrix)
      : first_column(matrix.ColPart()[0]), last_column(matrix.ColPart()[1])
   {
      matrix.GetDiag(diagonal);
      matrix.GetOffd(beside, column_numbers);
      diagonal_places.resize(diagonal.Width(), -1);
      beside_places.resize(beside.Width(), -1);
   }
   int Count() const
   {
      return diagonal.NumNonZeroElems() + beside.NumNonZeroElems();
   }
   void GoToRow(int row)
   {
      Number(diagonal, row, 0, diagonal_places);
      Number(beside, row, diagonal.NumNonZeroElems(), beside_places);
   }
   /// In the row that was gone to, which has an entry there.
   int Find(HYPRE_BigInt column) const
   {
      if (first_column <= column && column < last_column)
      {
         return diagonal_places[column - first_column];
      }
      const HYPRE_BigInt *const found = std::lower_bound(
         column_numbers, column_numbers + beside.Width(), column);
      return beside_places[found - column_numbers];
   }

private:
   static void Number(const SparseMatrix &block, int row, int first,
                      std::vector<int> &places_of)
   {
      for (int k = block.GetI()[row]; k < block.GetI()[row + 1]; k++)
      {
         places_of[block.GetJ()[k]] = first + k;
      }
   }

   HYPRE_BigInt first_column;
   HYPRE_BigInt last_column;
   SparseMatrix diagonal;
   SparseMatrix beside;
   /// They ascend.
   HYPRE_BigInt *column_numbers = nullptr;
   /// By column; of columns where the row has no entry, those of other rows.
   std::vector<int> diagonal_places;
   std::vector<int> beside_places;
};

std::vector<HYPRE_BigInt> EndsOfRanks(const ParFiniteElementSpace &space)
{
   const HYPRE_BigInt end = space.GetTrueDofOffsets()[1];
   std::vector<HYPRE_BigInt> ends(space.GetNRanks());
   MPI_Allgather(&end, sizeof(end), MPI_BYTE, ends.data(), sizeof(end),
                 MPI_BYTE, space.GetComm());
   return ends;
}

/// Global row and column.
using Position = std::array<HYPRE_BigInt, 2>;

/// Sets where local entries are in the sum, or, of rows of rank r, -1 - r, and
/// returns their positions, rank by rank.
std::vector<std::vector<Position>>
FindPlaces(const ParFiniteElementSpace &row_space,
           const ParFiniteElementSpace &column_space, const SparseMatrix &local,
           EntryPlaces &entries, std::vector<int> &places)
{
   const std::vector<HYPRE_BigInt> ends = EndsOfRanks(row_space);
   std::vector<HYPRE_BigInt> columns(column_space.GetVSize());
   for (int j = 0; j < column_space.GetVSize(); j++)
   {
      columns[j] = column_space.GetGlobalTDofNumber(j);
   }
   std::vector<std::vector<Position>> others(ends.size());
   places.resize(local.NumNonZeroElems());
   for (int row = 0; row < row_space.GetVSize(); row++)
   {
      const HYPRE_BigInt global_row = row_space.GetGlobalTDofNumber(row);
      const int owner = static_cast<int>(
         std::upper_bound(ends.begin(), ends.end(), global_row) - ends.begin());
      const bool mine = owner == row_space.GetMyRank();
      if (mine)
      {
         entries.GoToRow(
            static_cast<int>(global_row - row_space.GetMyTDofOffset()));
      }
      for (int k = local.GetI()[row]; k < local.GetI()[row + 1]; k++)
      {
         const HYPRE_BigInt column = columns[local.GetJ()[k]];
         places[k] = mine ? entries.Find(column) : -1 - owner;
         if (!mine)
         {
            others[owner].push_back({global_row, column});
         }
      }
   }
   return others;
}

// As the matrix frees it.
template <typename T>
Memory<T> Copied(const std::vector<T> &values)
{
   Memory<T> copy(static_cast<int>(values.size()));
   std::copy(values.begin(), values.end(), static_cast<T *>(copy));
   return copy;
}

Memory<real_t> Zeros(std::size_t size)
{
   Memory<real_t> zeros(static_cast<int>(size));
   std::fill_n(static_cast<real_t *>(zeros), size, 0.0);
   return zeros;
}
} // namespace

SharedSum::SharedSum(ParFiniteElementSpace &row_space_,
                     ParFiniteElementSpace &column_space_, SparseMatrix &local)
   : row_space(row_space_), column_space(column_space_)
{
   const std::unique_ptr<HypreParMatrix> pattern =
      SumShared(row_space, column_space, local);
   KeepPattern(*pattern);
   MFEM_VERIFY(std::int64_t(Entries()) + local.NumNonZeroElems() < INT_MAX,
               "a rank's matrix has more than 2^31 entries: use more ranks");
   EntryPlaces entries(*pattern);
   std::vector<std::vector<Position>> others =
      FindPlaces(row_space, column_space, local, entries, places);
   std::vector<int> next;
   int end = Entries();
   for (std::size_t r = 0; r < others.size(); r++)
   {
      const int count = static_cast<int>(others[r].size());
      next.push_back(end);
      end += count;
      if (count > 0)
      {
         outgoing.push_back({static_cast<int>(r), count});
      }
   }
   for (int &place : places)
   {
      place = place < 0 ? next[-1 - place]++ : place;
   }
   const std::vector<std::vector<Position>> wanted =
      Exchange(std::move(others), row_space.GetComm());
   for (std::size_t r = 0; r < wanted.size(); r++)
   {
      Incoming message{static_cast<int>(r), {}};
      for (const auto &[row, column] : wanted[r])
      {
         entries.GoToRow(static_cast<int>(row - row_space.GetMyTDofOffset()));
         message.places.push_back(entries.Find(column));
      }
      if (!message.places.empty())
      {
         incoming.push_back(std::move(message));
      }
   }
}

void SharedSum::KeepPattern(const HypreParMatrix &pattern)
{
   SparseMatrix diag;
   SparseMatrix offd;
   HYPRE_BigInt *numbers;
   pattern.GetDiag(diag);
   pattern.GetOffd(offd, numbers);
   const auto keep = [](const SparseMatrix &from, Block &block)
   {
      block.begins.assign(from.GetI(), from.GetI() + from.Height() + 1);
      block.columns.assign(from.GetJ(), from.GetJ() + from.NumNonZeroElems());
   };
   keep(diag, diagonal);
   keep(offd, beside);
   column_numbers.assign(numbers, numbers + offd.Width());
}

std::unique_ptr<HypreParMatrix>
SharedSum::Sum(std::vector<real_t> entries) const
{
   MFEM_VERIFY(entries.size() == places.size(),
               "the entries should be those of the local matrix");
   // The first two go to the matrix.
   Memory<real_t> diagonal_values = Zeros(diagonal.columns.size());
   Memory<real_t> beside_values = Zeros(beside.columns.size());
   std::vector<real_t> for_others(CountOutgoing(), 0.0);
   const Sums sums{diagonal_values, diagonal_values.Capacity(), beside_values,
                   Entries(), for_others.data()};
   for (std::size_t k = 0; k < entries.size(); k++)
   {
      sums.At(places[k]) += entries[k];
   }
   entries = std::vector<real_t>();
   AddIncoming(for_others, sums);
   return std::make_unique<HypreParMatrix>(
      row_space.GetComm(), row_space.GlobalTrueVSize(),
      column_space.GlobalTrueVSize(), row_space.GetTrueDofOffsets(),
      column_space.GetTrueDofOffsets(), Copied(diagonal.begins),
      Copied(diagonal.columns), diagonal_values, Copied(beside.begins),
      Copied(beside.columns), beside_values,
      static_cast<HYPRE_Int>(column_numbers.size()), Copied(column_numbers));
}

int SharedSum::CountOutgoing() const
{
   int count = 0;
   for (const Outgoing &message : outgoing)
   {
      count += message.count;
   }
   return count;
}

void SharedSum::AddIncoming(const std::vector<real_t> &for_others,
                            const Sums &sums) const
{
   MPI_Comm comm = row_space.GetComm();
   const MPI_Datatype type = MPITypeMap<real_t>::mpi_type;
   std::vector<MPI_Request> requests;
   std::vector<std::vector<real_t>> received;
   received.reserve(incoming.size());
   for (const Incoming &message : incoming)
   {
      received.emplace_back(message.places.size());
      requests.emplace_back();
      MPI_Irecv(received.back().data(), static_cast<int>(message.places.size()),
                type, message.rank, 0, comm, &requests.back());
   }
   int begin = 0;
   for (const Outgoing &message : outgoing)
   {
      requests.emplace_back();
      MPI_Isend(for_others.data() + begin, message.count, type, message.rank, 0,
                comm, &requests.back());
      begin += message.count;
   }
   MPI_Waitall(static_cast<int>(requests.size()), requests.data(),
               MPI_STATUSES_IGNORE);
   for (std::size_t r = 0; r < incoming.size(); r++)
   {
      for (std::size_t k = 0; k < received[r].size(); k++)
      {
         sums.At(incoming[r].places[k]) += received[r][k];
      }
   }
}

std::unique_ptr<HypreParMatrix> SumShared(ParFiniteElementSpace &row_space,
                                          ParFiniteElementSpace &column_space,
                                          SparseMatrix &local)
{
   const HypreParMatrix diagonal(
      row_space.GetComm(), row_space.GlobalVSize(), column_space.GlobalVSize(),
      row_space.GetDofOffsets(), column_space.GetDofOffsets(), &local);
   if (row_space.GetNRanks() == 1 && row_space.Conforming() &&
       column_space.Conforming())
   {
      return std::make_unique<HypreParMatrix>(diagonal);
   }
   const std::unique_ptr<HypreParMatrix> columns(
      ParMult(&diagonal, column_space.Dof_TrueDof_Matrix()));
   const std::unique_ptr<HypreParMatrix> transpose(
      row_space.Dof_TrueDof_Matrix()->Transpose());
   return std::unique_ptr<HypreParMatrix>(
      ParMult(transpose.get(), columns.get(), true));
}

} // namespace synovia
