#include "synovia/mesh/hex_layer_share.hpp"
#include "synovia/mesh/hex_layer_cells.hpp"

#include <numeric>

namespace synovia
{

using namespace mfem;

namespace
{
/// Positions in the layers, of which the grids' cells have straight edges.
class BentUpperLayer : public VectorCoefficient
{
public:
   explicit BentUpperLayer(const LayersOptions &options_)
      : VectorCoefficient(3), options(options_)
   {
   }
   void Eval(Vector &to, ElementTransformation &map,
             const IntegrationPoint &point) override
   {
      map.Transform(point, to);
      if (map.Attribute == 2)
      {
         to[2] += BendAt(options, to);
      }
   }

private:
   const LayersOptions &options;
};

/// The mesh of some cells, whose order and that of their vertices it keeps.
class CellMesh
{
public:
   CellMesh(const LayersOptions &options_,
            const std::array<LayerGrid, 2> &grids_,
            const std::vector<LayerCell> &cells)
      : options(options_), grids(grids_)
   {
      for (const LayerCell &cell : cells)
      {
         const std::array<int, 8> corners = Corners(cell);
         vertices.insert(vertices.end(), corners.begin(), corners.end());
      }
      std::sort(vertices.begin(), vertices.end());
      vertices.erase(std::unique(vertices.begin(), vertices.end()),
                     vertices.end());
      mesh = Mesh(3, static_cast<int>(vertices.size()),
                  static_cast<int>(cells.size()), 0, 3);
      for (const int vertex : vertices)
      {
         AddVertex(vertex);
      }
      for (const LayerCell &cell : cells)
      {
         AddCell(cell);
      }
      mesh.FinalizeTopology(false);
      mesh.Finalize(false, false);
      Bend();
   }
   Mesh &Get() { return mesh; }

private:
   /// Numbered through both layers.
   std::array<int, 8> Corners(const LayerCell &cell) const
   {
      const int first = cell.layer == 0 ? 0 : grids[0].Vertices();
      const LayerGrid::Place &at = cell.place;
      const auto vertex = [&](int x, int y, int z) {
         return first +
                grids[cell.layer].Vertex({at[0] + x, at[1] + y, at[2] + z});
      };
      return {vertex(0, 0, 0), vertex(1, 0, 0), vertex(1, 1, 0),
              vertex(0, 1, 0), vertex(0, 0, 1), vertex(1, 0, 1),
              vertex(1, 1, 1), vertex(0, 1, 1)};
   }

   void AddVertex(int vertex)
   {
      const int layer = vertex < grids[0].Vertices() ? 0 : 1;
      const LayerGrid &grid = grids[layer];
      const LayerGrid::Place at =
         grid.PlaceOfVertex(vertex - (layer == 0 ? 0 : grids[0].Vertices()));
      const real_t bottom = layer == 0 ? -options.thickness : 0.0;
      mesh.AddVertex(options.width * at[0] / grid.across,
                     options.width * at[1] / grid.across,
                     bottom + options.thickness * at[2] / grid.through);
   }

   void AddCell(const LayerCell &cell)
   {
      std::array<int, 8> corners = Corners(cell);
      for (int &corner : corners)
      {
         const auto found =
            std::lower_bound(vertices.begin(), vertices.end(), corner);
         corner = static_cast<int>(found - vertices.begin());
      }
      mesh.AddHex(corners.data(), 1 + cell.layer);
      const LayerGrid &grid = grids[cell.layer];
      const LayerGrid::Place &at = cell.place;
      const std::array<bool, 6> outside = {at[2] == 0,
                                           at[1] == 0,
                                           at[0] == grid.across - 1,
                                           at[1] == grid.across - 1,
                                           at[0] == 0,
                                           at[2] == grid.through - 1};
      for (int side = 0; side < 6; side++)
      {
         if (outside[side])
         {
            const int *of = Geometry::Constants<Geometry::CUBE>::FaceVert[side];
            mesh.AddBdrQuad(corners[of[0]], corners[of[1]], corners[of[2]],
                            corners[of[3]], 6 * cell.layer + side + 1);
         }
      }
   }

   void Bend()
   {
      mesh.SetCurvature(2);
      BentUpperLayer bent(options);
      GridFunction nodes(mesh.GetNodes()->FESpace());
      nodes.ProjectCoefficient(bent);
      *mesh.GetNodes() = nodes;
   }

   const LayersOptions &options;
   const std::array<LayerGrid, 2> &grids;
   std::vector<int> vertices;
   Mesh mesh;
};

// The cells around this rank's are gone when its mesh is made.
std::vector<char> TextOfOwn(const LayersOptions &options,
                            const std::array<LayerGrid, 2> &grids,
                            const std::vector<LayerCell> &cells, MPI_Comm comm)
{
   int rank = 0;
   int ranks = 1;
   MPI_Comm_rank(comm, &rank);
   MPI_Comm_size(comm, &ranks);
   std::vector<int> owners;
   for (const LayerCell &cell : cells)
   {
      owners.push_back(cell.rank);
   }
   CellMesh around(options, grids, cells);
   return TextOfShare(MeshPartitioner(around.Get(), ranks, owners.data()),
                      rank);
}
} // namespace

MeshShare MakeHexLayerShare(const LayersOptions &options, MPI_Comm comm)
{
   const std::array<LayerGrid, 2> grids = {
      LayerGrid(options, options.lower_cells),
      LayerGrid(options, options.upper_cells)};
   int rank = 0;
   MPI_Comm_rank(comm, &rank);
   const std::vector<LayerCell> cells = ScatterCells(grids, comm);
   MeshShare share;
   for (const LayerCell &cell : cells)
   {
      if (cell.rank == rank)
      {
         share.serial_elements.push_back(cell.number);
      }
   }
   share.mesh = JoinShares(TextOfOwn(options, grids, cells, comm), comm);
   share.mesh->attributes.SetSize(2);
   share.mesh->bdr_attributes.SetSize(12);
   std::iota(share.mesh->attributes.begin(), share.mesh->attributes.end(), 1);
   std::iota(share.mesh->bdr_attributes.begin(),
             share.mesh->bdr_attributes.end(), 1);
   return share;
}

} // namespace synovia
