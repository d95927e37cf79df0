#include "synovia/mesh/hex_layer_cells.hpp"
#include "synovia/mesh/mesh_share.hpp"

#include <metis.h>

#include <algorithm>
#include <functional>
#include <memory>
#include <set>

namespace synovia
{

using namespace mfem;

namespace
{
using Place = LayerGrid::Place;

/// Cells of both layers, one after the other, each in the order of a
/// space-filling curve.
class Cells
{
public:
   explicit Cells(const std::array<LayerGrid, 2> &grids_) : grids(grids_)
   {
      for (const LayerGrid &grid : grids)
      {
         const int first = Size();
         Array<int> curve;
         NCMesh::GridSfcOrdering3D(grid.across, grid.across, grid.through,
                                   curve);
         numbers.emplace_back(grid.Cells());
         for (int i = 0; i < grid.Cells(); i++)
         {
            places.push_back(
               {curve[3 * i], curve[3 * i + 1], curve[3 * i + 2]});
            numbers.back()[Index(grid, places.back())] = first + i;
         }
      }
   }

   int Size() const { return static_cast<int>(places.size()); }
   int LayerOf(int cell) const { return cell < grids[0].Cells() ? 0 : 1; }
   const Place &PlaceOf(int cell) const { return places[cell]; }

   /// Calls @a visit(neighbor) for those with which a cell has at least a face
   /// (@a most = 1) or a vertex (3) in common.
   template <typename Visit>
   void ForNeighbors(int cell, int most, const Visit &visit) const
   {
      const int layer = LayerOf(cell);
      const Place &at = places[cell];
      for (int i = 0; i < 27; i++)
      {
         const Place shift = {i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1};
         const int distance =
            std::abs(shift[0]) + std::abs(shift[1]) + std::abs(shift[2]);
         const Place to = {at[0] + shift[0], at[1] + shift[1],
                           at[2] + shift[2]};
         if (distance > 0 && distance <= most && grids[layer].HasCell(to))
         {
            visit(numbers[layer][Index(grids[layer], to)]);
         }
      }
   }

private:
   static int Index(const LayerGrid &grid, const Place &at)
   {
      return at[0] + (at[1] + at[2] * grid.across) * grid.across;
   }

   std::array<LayerGrid, 2> grids;
   std::vector<Place> places;
   std::vector<std::vector<int>> numbers;
};

/// A rank for each cell, as Mesh::GeneratePartitioning() gives them.
std::vector<int> Partition(const Cells &cells, int ranks)
{
   std::vector<idx_t> part(cells.Size(), 0);
   if (ranks > 1 && cells.Size() > ranks)
   {
      std::vector<idx_t> begins{0};
      std::vector<idx_t> neighbors;
      for (int i = 0; i < cells.Size(); i++)
      {
         cells.ForNeighbors(i, 1, [&](int to) { neighbors.push_back(to); });
         std::sort(neighbors.begin() + begins.back(), neighbors.end(),
                   std::greater<idx_t>());
         begins.push_back(static_cast<idx_t>(neighbors.size()));
      }
      idx_t count = cells.Size();
      idx_t constraints = 1;
      idx_t parts = ranks;
      idx_t cut = 0;
      const int status = METIS_PartGraphKway(
         &count, &constraints, begins.data(), neighbors.data(), nullptr,
         nullptr, nullptr, &parts, nullptr, nullptr, nullptr, &cut,
         part.data());
      MFEM_VERIFY(status == METIS_OK, "METIS could not partition the layers");
   }
   std::vector<int> counts(ranks, 0);
   for (const idx_t rank : part)
   {
      counts[rank]++;
   }
   if (*std::min_element(counts.begin(), counts.end()) == 0)
   {
      // METIS may leave parts of a few cells empty; those of the curve are not.
      for (int i = 0; i < cells.Size(); i++)
      {
         part[i] = static_cast<idx_t>(1LL * i * ranks / cells.Size());
      }
   }
   return std::vector<int>(part.begin(), part.end());
}

} // namespace

std::vector<LayerCell> ScatterCells(const std::array<LayerGrid, 2> &grids,
                                    MPI_Comm comm)
{
   int rank = 0;
   int ranks = 1;
   MPI_Comm_rank(comm, &rank);
   MPI_Comm_size(comm, &ranks);
   VerifyRanks(ranks, grids[0].Cells() + grids[1].Cells());
   std::unique_ptr<Cells> cells;
   std::vector<int> part;
   std::vector<std::vector<int>> own(ranks);
   if (rank == 0)
   {
      cells = std::make_unique<Cells>(grids);
      part = Partition(*cells, ranks);
      for (int i = 0; i < cells->Size(); i++)
      {
         own[part[i]].push_back(i);
      }
   }
   return ScatterLists<LayerCell>(
      [&](int to)
      {
         std::set<int> around(own[to].begin(), own[to].end());
         for (const int cell : own[to])
         {
            cells->ForNeighbors(cell, 3, [&](int i) { around.insert(i); });
         }
         std::vector<LayerCell> list;
         for (const int i : around)
         {
            list.push_back({i, cells->LayerOf(i), cells->PlaceOf(i), part[i]});
         }
         return list;
      },
      comm);
}

} // namespace synovia
