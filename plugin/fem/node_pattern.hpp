#pragma once

#include "mfem.hpp"

#include <cstdint>
#include <vector>

namespace synovia
{

/// Where a distributed matrix between two finite element spaces of a mesh has
/// entries: in rows and columns of nodes that share an element, on any rank.
///
/// All components of a node are coupled to all of another, so that nodes are
/// what is counted and numbered here: a ninth of what there is of entries
/// between displacements. Spaces whose nodes are the same have the same
/// pattern.
class NodePattern
{
public:
   /// Components of a node must follow each other in both spaces, which must be
   /// conforming and are not borrowed. Collective.
   NodePattern(const mfem::ParFiniteElementSpace &rows,
               const mfem::ParFiniteElementSpace &columns);

   /// Nodes of this rank's part of the mesh, by their local numbers.
   int RowNodes() const { return static_cast<int>(row_of.size()); }
   int ColumnNodes() const { return static_cast<int>(column_numbers.size()); }

   /// Nodes that share elements with others.
   struct Lists
   {
      /// Where each node's list begins, and one more.
      std::vector<int> begins{0};
      std::vector<int> nodes;
      /// Whether each list does, once all are there; for Find().
      std::vector<bool> ascends;

      int Begin(int node) const { return begins[node]; }
      int Length(int node) const { return begins[node + 1] - begins[node]; }
      void FindAscending();
      /// Place of a node in a list that has it.
      int Find(int list, int node) const;
   };
   /// Of each row of this rank: columns of this rank. Those that other ranks
   /// add come first, as in hypre's products of matrices: its coarsening
   /// depends on the order (12 systems took 136 iterations on two ranks, and
   /// 146 where all ascended).
   const Lists &Diagonal() const { return diagonal; }
   /// And those of other ranks, by their place in BesideNumbers().
   const Lists &Beside() const { return beside; }
   /// Global numbers of nodes of other ranks, ascending.
   const std::vector<HYPRE_BigInt> &BesideNumbers() const
   {
      return beside_numbers;
   }

   /// Where a row of a node of the mesh is, by its local number: that of one of
   /// this rank's rows, or -1 - k of the k-th of Foreign().
   int Row(int node) const { return row_of[node]; }
   /// Rows of other ranks to which elements of this one add, sorted by rank:
   /// their columns by local numbers, ascending.
   const Lists &Foreign() const { return foreign; }
   /// Where a row's column is: the place in its list of Diagonal(), or of
   /// Foreign(), or -1 - place in that of Beside(). Both by local numbers; they
   /// must share an element.
   int Place(int row_node, int column_node) const;
   /// The same of all nodes of an element, row by row.
   const std::int16_t *Places(int element) const
   {
      return places.data() + place_begins[element];
   }

   /// How many of the foreign rows a rank gets.
   struct Outgoing
   {
      int rank;
      int rows;
   };
   const std::vector<Outgoing> &GetOutgoing() const { return outgoing; }
   /// Rows to which elements of a rank add, as it sends them, with the places
   /// of their columns as Place() has them.
   struct Incoming
   {
      int rank;
      std::vector<int> rows;
      Lists places;
   };
   const std::vector<Incoming> &GetIncoming() const { return incoming; }

private:
   class Numbering;
   /// Rows by their global numbers, each followed by how many columns it has
   /// and theirs.
   using Message = std::vector<HYPRE_BigInt>;

   /// Returns what each rank gets.
   std::vector<Message> FindForeign(const Numbering &rows,
                                    const mfem::Table &neighbors);
   void FindColumns(const Numbering &rows, const mfem::Table &neighbors,
                    const std::vector<Message> &received);
   void FindIncoming(const Numbering &rows,
                     const std::vector<Message> &received);
   void FindPlaces(const mfem::Table &rows, const mfem::Table &columns);
   bool IsMine(HYPRE_BigInt column) const
   {
      return first_column <= column && column < end_column;
   }
   /// Of a node of another rank by its global number, in BesideNumbers().
   int PlaceBeside(HYPRE_BigInt column) const;
   /// Of a column by its global number in a row of this rank.
   int PlaceInRow(int row, HYPRE_BigInt column) const;

   Lists diagonal;
   Lists beside;
   Lists foreign;
   std::vector<HYPRE_BigInt> beside_numbers;
   std::vector<int> row_of;
   /// By local number.
   std::vector<HYPRE_BigInt> column_numbers;
   /// This rank's columns.
   HYPRE_BigInt first_column = 0;
   HYPRE_BigInt end_column = 0;
   std::vector<std::int16_t> places;
   std::vector<std::size_t> place_begins;
   std::vector<Outgoing> outgoing;
   std::vector<Incoming> incoming;
};

} // namespace synovia
