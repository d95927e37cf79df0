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
} // namespace

SharedSum::SharedSum(ParFiniteElementSpace &row_space,
                     ParFiniteElementSpace &column_space, SparseMatrix &local)
   : comm(row_space.GetComm()),
     pattern(SumShared(row_space, column_space, local))
{
   EntryPlaces entries(*pattern);
   MFEM_VERIFY(std::int64_t(entries.Count()) + local.NumNonZeroElems() <
                  INT_MAX,
               "a rank's matrix has more than 2^31 entries: use more ranks");
   std::vector<std::vector<Position>> others =
      FindPlaces(row_space, column_space, local, entries, places);
   std::vector<int> next;
   int end = entries.Count();
   for (std::size_t r = 0; r < others.size(); r++)
   {
      next.push_back(end);
      end += static_cast<int>(others[r].size());
      if (!others[r].empty())
      {
         outgoing.push_back(
            {static_cast<int>(r), std::vector<real_t>(others[r].size()), {}});
      }
   }
   sums.resize(end);
   for (int &place : places)
   {
      place = place < 0 ? next[-1 - place]++ : place;
   }
   const std::vector<std::vector<Position>> wanted =
      Exchange(std::move(others), comm);
   for (std::size_t r = 0; r < wanted.size(); r++)
   {
      Message message{
         static_cast<int>(r), std::vector<real_t>(wanted[r].size()), {}};
      for (const auto &[row, column] : wanted[r])
      {
         entries.GoToRow(static_cast<int>(row - row_space.GetMyTDofOffset()));
         message.places.push_back(entries.Find(column));
      }
      if (!wanted[r].empty())
      {
         incoming.push_back(std::move(message));
      }
   }
}

std::unique_ptr<HypreParMatrix>
SharedSum::Sum(const std::vector<real_t> &entries)
{
   MFEM_VERIFY(entries.size() == places.size(),
               "the entries should be those of the local matrix");
   std::fill(sums.begin(), sums.end(), 0.0);
   for (std::size_t k = 0; k < entries.size(); k++)
   {
      sums[places[k]] += entries[k];
   }
   ExchangeShared();
   auto sum = std::make_unique<HypreParMatrix>(*pattern);
   sum->HostReadWrite();
   SparseMatrix diagonal;
   SparseMatrix beside;
   HYPRE_BigInt *column_numbers;
   sum->GetDiag(diagonal);
   sum->GetOffd(beside, column_numbers);
   const real_t *const middle = sums.data() + diagonal.NumNonZeroElems();
   std::copy(static_cast<const real_t *>(sums.data()), middle,
             diagonal.GetData());
   std::copy(middle, middle + beside.NumNonZeroElems(), beside.GetData());
   sum->HypreRead();
   return sum;
}

void SharedSum::ExchangeShared()
{
   std::vector<MPI_Request> requests;
   for (Message &message : incoming)
   {
      requests.emplace_back();
      MPI_Irecv(message.values.data(), static_cast<int>(message.values.size()),
                MPITypeMap<real_t>::mpi_type, message.rank, 0, comm,
                &requests.back());
   }
   std::size_t begin = sums.size();
   for (const Message &message : outgoing)
   {
      begin -= message.values.size();
   }
   for (Message &message : outgoing)
   {
      std::copy_n(sums.begin() + begin, message.values.size(),
                  message.values.begin());
      begin += message.values.size();
      requests.emplace_back();
      MPI_Isend(message.values.data(), static_cast<int>(message.values.size()),
                MPITypeMap<real_t>::mpi_type, message.rank, 0, comm,
                &requests.back());
   }
   MPI_Waitall(static_cast<int>(requests.size()), requests.data(),
               MPI_STATUSES_IGNORE);
   for (const Message &message : incoming)
   {
      for (std::size_t k = 0; k < message.places.size(); k++)
      {
         sums[message.places[k]] += message.values[k];
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
