#include "synovia/fem/node_pattern.hpp"
#include "synovia/general/exchange.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <map>

namespace synovia
{

using namespace mfem;

/// Nodes of a space by their global numbers, rank by rank.
class NodePattern::Numbering
{
public:
   /// Collective.
   explicit Numbering(const ParFiniteElementSpace &space)
      : rank(space.GetMyRank()), ends(space.GetNRanks())
   {
      const int dim = space.GetVDim();
      MFEM_VERIFY(dim == 1 || space.GetOrdering() == Ordering::byVDIM,
                  "components of a node should follow each other");
      MFEM_VERIFY(space.Conforming(), "the mesh should have no hanging nodes");
      const HYPRE_BigInt end =
         (space.GetMyTDofOffset() + space.GetTrueVSize()) / dim;
      MPI_Allgather(&end, sizeof(end), MPI_BYTE, ends.data(), sizeof(end),
                    MPI_BYTE, space.GetComm());
      numbers.reserve(space.GetNDofs());
      for (int node = 0; node < space.GetNDofs(); node++)
      {
         numbers.push_back(space.GetGlobalTDofNumber(dim * node) / dim);
      }
   }

   int Ranks() const { return static_cast<int>(ends.size()); }
   int Nodes() const { return static_cast<int>(numbers.size()); }
   const std::vector<HYPRE_BigInt> &Numbers() const { return numbers; }
   HYPRE_BigInt First() const { return rank == 0 ? 0 : ends[rank - 1]; }
   HYPRE_BigInt End() const { return ends[rank]; }
   int Owner(int node) const
   {
      return static_cast<int>(
         std::upper_bound(ends.begin(), ends.end(), numbers[node]) -
         ends.begin());
   }
   bool IsMine(int node) const { return Owner(node) == rank; }
   /// Among those of this rank.
   int OwnNumber(HYPRE_BigInt number) const
   {
      return static_cast<int>(number - First());
   }

private:
   int rank;
   /// Of each rank's numbers.
   std::vector<HYPRE_BigInt> ends;
   std::vector<HYPRE_BigInt> numbers;
};

namespace
{
// Columns that share elements with each row, ascending.
Table Neighbors(const ParFiniteElementSpace &rows,
                const ParFiniteElementSpace &columns)
{
   Table elements;
   Transpose(rows.GetElementToDofTable(), elements, rows.GetNDofs());
   Table neighbors;
   mfem::Mult(elements, columns.GetElementToDofTable(), neighbors);
   neighbors.SortRows();
   return neighbors;
}

// Calls work(row, columns, count) for each row of a message.
template <typename Work>
void ForEachRow(const std::vector<HYPRE_BigInt> &message, const Work &work)
{
   for (std::size_t k = 0; k < message.size(); k += 2 + message[k + 1])
   {
      work(message[k], message.data() + k + 2,
           static_cast<int>(message[k + 1]));
   }
}

void SortUnique(std::vector<HYPRE_BigInt> &numbers)
{
   std::sort(numbers.begin(), numbers.end());
   numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
}

// Appends what isn't there yet; @a more has no number twice.
void AddNew(const std::vector<HYPRE_BigInt> &more,
            std::vector<HYPRE_BigInt> &numbers)
{
   const std::size_t before = numbers.size();
   for (const HYPRE_BigInt number : more)
   {
      const auto end = numbers.begin() + before;
      if (std::find(numbers.begin(), end, number) == end)
      {
         numbers.push_back(number);
      }
   }
}
} // namespace

void NodePattern::Lists::FindAscending()
{
   ascends.clear();
   for (std::size_t list = 1; list < begins.size(); list++)
   {
      ascends.push_back(std::is_sorted(nodes.begin() + begins[list - 1],
                                       nodes.begin() + begins[list]));
   }
}

int NodePattern::Lists::Find(int list, int node) const
{
   const auto first = nodes.begin() + begins[list];
   const auto last = nodes.begin() + begins[list + 1];
   const auto found = ascends[list] ? std::lower_bound(first, last, node)
                                    : std::find(first, last, node);
   MFEM_VERIFY(found != last && *found == node,
               "both nodes should share an element");
   return static_cast<int>(found - first);
}

NodePattern::NodePattern(const ParFiniteElementSpace &row_space,
                         const ParFiniteElementSpace &column_space)
{
   const Numbering rows(row_space);
   const Numbering columns(column_space);
   column_numbers = columns.Numbers();
   first_column = columns.First();
   end_column = columns.End();
   const Table neighbors = Neighbors(row_space, column_space);
   const std::vector<Message> received =
      Exchange(FindForeign(rows, neighbors), row_space.GetComm());
   FindColumns(rows, neighbors, received);
   FindIncoming(rows, received);
   FindPlaces(row_space.GetElementToDofTable(),
              column_space.GetElementToDofTable());
}

std::vector<NodePattern::Message>
NodePattern::FindForeign(const Numbering &rows, const Table &neighbors)
{
   std::vector<std::array<int, 2>> by_rank;
   row_of.resize(rows.Nodes());
   for (int node = 0; node < rows.Nodes(); node++)
   {
      if (rows.IsMine(node))
      {
         row_of[node] = rows.OwnNumber(rows.Numbers()[node]);
      }
      else
      {
         by_rank.push_back({rows.Owner(node), node});
      }
   }
   std::sort(by_rank.begin(), by_rank.end());
   std::vector<Message> messages(rows.Ranks());
   for (const auto &[rank, node] : by_rank)
   {
      row_of[node] = -static_cast<int>(foreign.begins.size());
      if (outgoing.empty() || outgoing.back().rank != rank)
      {
         outgoing.push_back({rank, 0});
      }
      outgoing.back().rows++;
      messages[rank].push_back(rows.Numbers()[node]);
      messages[rank].push_back(neighbors.RowSize(node));
      for (int k = 0; k < neighbors.RowSize(node); k++)
      {
         const int column = neighbors.GetRow(node)[k];
         foreign.nodes.push_back(column);
         messages[rank].push_back(column_numbers[column]);
      }
      foreign.begins.push_back(static_cast<int>(foreign.nodes.size()));
   }
   foreign.FindAscending();
   return messages;
}

void NodePattern::FindColumns(const Numbering &rows, const Table &neighbors,
                              const std::vector<Message> &received)
{
   const int size = static_cast<int>(rows.End() - rows.First());
   std::vector<int> node_of(size);
   for (int node = 0; node < rows.Nodes(); node++)
   {
      if (row_of[node] >= 0)
      {
         node_of[row_of[node]] = node;
      }
   }
   std::multimap<int, std::vector<HYPRE_BigInt>> added;
   for (const Message &message : received)
   {
      ForEachRow(message,
                 [&](HYPRE_BigInt row, const HYPRE_BigInt *columns, int count)
                 {
                    added.emplace(
                       rows.OwnNumber(row),
                       std::vector<HYPRE_BigInt>(columns, columns + count));
                 });
   }
   std::vector<HYPRE_BigInt> numbers;
   std::vector<HYPRE_BigInt> own;
   std::vector<HYPRE_BigInt> numbers_beside;
   for (int row = 0; row < size; row++)
   {
      numbers.clear();
      const auto range = added.equal_range(row);
      for (auto more = range.first; more != range.second; ++more)
      {
         AddNew(more->second, numbers);
      }
      own.clear();
      for (int k = 0; k < neighbors.RowSize(node_of[row]); k++)
      {
         own.push_back(column_numbers[neighbors.GetRow(node_of[row])[k]]);
      }
      AddNew(own, numbers);
      for (const HYPRE_BigInt number : numbers)
      {
         if (IsMine(number))
         {
            diagonal.nodes.push_back(static_cast<int>(number - first_column));
         }
         else
         {
            numbers_beside.push_back(number);
         }
      }
      diagonal.begins.push_back(static_cast<int>(diagonal.nodes.size()));
      beside.begins.push_back(static_cast<int>(numbers_beside.size()));
   }
   beside_numbers = numbers_beside;
   SortUnique(beside_numbers);
   beside.nodes.reserve(numbers_beside.size());
   for (const HYPRE_BigInt number : numbers_beside)
   {
      beside.nodes.push_back(PlaceBeside(number));
   }
   diagonal.FindAscending();
   beside.FindAscending();
}

int NodePattern::PlaceBeside(HYPRE_BigInt column) const
{
   return static_cast<int>(
      std::lower_bound(beside_numbers.begin(), beside_numbers.end(), column) -
      beside_numbers.begin());
}

int NodePattern::PlaceInRow(int row, HYPRE_BigInt column) const
{
   return IsMine(column)
             ? diagonal.Find(row, static_cast<int>(column - first_column))
             : -1 - beside.Find(row, PlaceBeside(column));
}

int NodePattern::Place(int row_node, int column_node) const
{
   const int row = row_of[row_node];
   return row >= 0 ? PlaceInRow(row, column_numbers[column_node])
                   : foreign.Find(-1 - row, column_node);
}

void NodePattern::FindIncoming(const Numbering &rows,
                               const std::vector<Message> &received)
{
   for (std::size_t rank = 0; rank < received.size(); rank++)
   {
      if (received[rank].empty())
      {
         continue;
      }
      incoming.emplace_back();
      Incoming &message = incoming.back();
      message.rank = static_cast<int>(rank);
      ForEachRow(
         received[rank],
         [&](HYPRE_BigInt number, const HYPRE_BigInt *columns, int count)
         {
            const int row = rows.OwnNumber(number);
            message.rows.push_back(row);
            for (int k = 0; k < count; k++)
            {
               message.places.nodes.push_back(PlaceInRow(row, columns[k]));
            }
            message.places.begins.push_back(
               static_cast<int>(message.places.nodes.size()));
         });
   }
}

void NodePattern::FindPlaces(const Table &rows, const Table &columns)
{
   place_begins.push_back(0);
   for (int e = 0; e < rows.Size(); e++)
   {
      place_begins.push_back(place_begins.back() +
                             rows.RowSize(e) * columns.RowSize(e));
   }
   places.reserve(place_begins.back());
   for (int e = 0; e < rows.Size(); e++)
   {
      for (int i = 0; i < rows.RowSize(e); i++)
      {
         for (int j = 0; j < columns.RowSize(e); j++)
         {
            const int place = Place(rows.GetRow(e)[i], columns.GetRow(e)[j]);
            MFEM_VERIFY(std::abs(place) < INT16_MAX,
                        "a node has more than 32767 neighbors");
            places.push_back(static_cast<std::int16_t>(place));
         }
      }
   }
}

} // namespace synovia
