#pragma once

#include "synovia/mesh/curved_layers.hpp"

#include <algorithm>
#include <array>
#include <vector>

namespace synovia
{

/// The cells of a layer of hexahedra, and their vertices, by their places: how
/// many of them are before it along x, y and z.
struct LayerGrid
{
   using Place = std::array<int, 3>;

   explicit LayerGrid(const LayersOptions &options, int cells)
      : across(cells), through(CellsThrough(options, cells))
   {
   }

   int Cells() const { return across * across * through; }
   int Vertices() const { return (across + 1) * (across + 1) * (through + 1); }
   int Vertex(const Place &at) const
   {
      return at[0] + (at[1] + at[2] * (across + 1)) * (across + 1);
   }
   Place PlaceOfVertex(int vertex) const
   {
      const int line = vertex / (across + 1);
      return {vertex % (across + 1), line % (across + 1), line / (across + 1)};
   }
   bool HasCell(const Place &at) const
   {
      return std::min({at[0], at[1], at[2]}) >= 0 &&
             std::max(at[0], at[1]) < across && at[2] < through;
   }

   int across;
   int through;
};

/// A cell of two layers: its number in both together, those of the lower one
/// first, which layer it is in (0 or 1), and the rank that it belongs to.
struct LayerCell
{
   int number;
   int layer;
   LayerGrid::Place place;
   int rank;
};

/// Collective. This rank's cells and those that have a vertex in common with
/// one of them, by their numbers. They are cut by METIS, on rank 0. Throws
/// Error where there are more ranks than cells.
std::vector<LayerCell> ScatterCells(const std::array<LayerGrid, 2> &grids,
                                    MPI_Comm comm);

} // namespace synovia
