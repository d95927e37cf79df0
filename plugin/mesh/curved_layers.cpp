#include "synovia/mesh/curved_layers.hpp"
#include "synovia/general/error.hpp"
#include "synovia/mesh/hex_layer_share.hpp"
#include "synovia/mesh/stack_bodies.hpp"

#include <algorithm>
#include <cmath>

namespace synovia
{

using namespace mfem;

namespace
{
void Check(const LayersOptions &options)
{
   const auto positive = [](real_t x) { return x > 0.0 && std::isfinite(x); };
   if (options.lower_cells < 1 || options.upper_cells < 1)
   {
      throw Error(
         "a layer needs at least one cell along an edge, not " +
         std::to_string(std::min(options.lower_cells, options.upper_cells)));
   }
   if (options.refine < 0)
   {
      throw Error("elements can't be split " + std::to_string(options.refine) +
                  " times");
   }
   if (!positive(options.width) || !positive(options.thickness) ||
       !positive(options.curvature_radius))
   {
      throw Error("width, thickness and radius of curvature of the layers must "
                  "be positive");
   }
   if (options.type != Element::HEXAHEDRON &&
       options.type != Element::TETRAHEDRON)
   {
      throw Error("layers are made of hexahedra or tetrahedra");
   }
}

// [0, width]^2 x [0, thickness], with curved elements.
Mesh MakeSlab(const LayersOptions &options, int cells)
{
   Mesh slab = Mesh::MakeCartesian3D(cells, cells, CellsThrough(options, cells),
                                     options.type, options.width, options.width,
                                     options.thickness);
   slab.SetCurvature(2);
   return slab;
}

void Lower(Mesh &slab, real_t thickness)
{
   slab.Transform(
      [thickness](const Vector &from, Vector &to)
      {
         to = from;
         to[2] -= thickness;
      });
}

void Bend(Mesh &slab, const LayersOptions &options)
{
   slab.Transform(
      [&options](const Vector &from, Vector &to)
      {
         to = from;
         to[2] += BendAt(options, from);
      });
}

MeshShare ScatterLayers(const LayersOptions &options, const NameTable &regions,
                        const NameTable &boundaries, MPI_Comm comm)
{
   int rank = 0;
   MPI_Comm_rank(comm, &rank);
   StackedBodies both;
   if (rank == 0)
   {
      Mesh lower = MakeSlab(options, options.lower_cells);
      Mesh upper = MakeSlab(options, options.upper_cells);
      Lower(lower, options.thickness);
      Bend(upper, options);
      both = StackBodies({&lower, &upper});
   }
   std::vector<int> by_metis;
   return ScatterMesh(both.mesh, regions, boundaries, comm, by_metis);
}
} // namespace

int CellsThrough(const LayersOptions &options, int cells)
{
   const real_t through = cells * options.thickness / options.width;
   return std::max(1, static_cast<int>(std::lround(through)));
}

real_t BendAt(const LayersOptions &options, const Vector &x)
{
   return (x[0] * x[0] + x[1] * x[1]) / (2.0 * options.curvature_radius);
}

NamedMesh MakeCurvedLayers(const LayersOptions &options, MPI_Comm comm)
{
   Check(options);
   // Of a slab MFEM numbers the faces z0, y0, x1, y1, x0, z1.
   constexpr int above = 6;
   const NameTable regions = {{"lower", {1}}, {"upper", {2}}};
   const NameTable boundaries = {{"lower_bone", {1}},
                                 {"lower_contact", {6}},
                                 {"upper_contact", {above + 1}},
                                 {"upper_bone", {above + 6}},
                                 {"symmetry_x", {5, above + 5}},
                                 {"symmetry_y", {2, above + 2}},
                                 {"rims", {3, 4, above + 3, above + 4}}};
   MeshShare share = options.type == Element::HEXAHEDRON
                        ? MakeHexLayerShare(options, comm)
                        : ScatterLayers(options, regions, boundaries, comm);
   RefineUniformly(share, options.refine);
   return NamedMesh(std::move(share.mesh), regions, boundaries,
                    std::move(share.serial_elements));
}

} // namespace synovia
