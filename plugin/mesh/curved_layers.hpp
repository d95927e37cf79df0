#pragma once

#include "synovia/mesh/named_mesh.hpp"

namespace synovia
{

/// A quarter of two layers that touch at a point, for measurements on meshes of
/// any size.
///
/// The lower one is flat, [0, width]^2 x [-thickness, 0]. The upper one has the
/// same thickness and follows the paraboloid z = r^2 / (2 R), which elements of
/// second order represent exactly on both of its faces.
struct LayersOptions
{
   /// HEXAHEDRON, or TETRAHEDRON: six for each cell.
   mfem::Element::Type type = mfem::Element::HEXAHEDRON;
   mfem::real_t width = 2.0;
   mfem::real_t thickness = 1.0;
   mfem::real_t curvature_radius = 10.0;
   /// Cells of each layer along an edge; through the thickness there are as
   /// many as make them about cubes. Different numbers give surfaces that don't
   /// match.
   int lower_cells = 8;
   int upper_cells = 6;
   /// How often each element is split after the mesh was distributed: rank 0
   /// has a part in all that are distributed, and holds tetrahedra whole.
   int refine = 0;
};

/// Cells through the thickness of a layer with so many along an edge.
int CellsThrough(const LayersOptions &options, int cells);

/// How far the upper layer is bent up at a point of it.
mfem::real_t BendAt(const LayersOptions &options, const mfem::Vector &x);

/// The layers with the regions "lower" and "upper" and the boundaries
/// lower_bone, lower_contact, upper_contact, upper_bone, symmetry_x (x = 0),
/// symmetry_y and rims. Collective. Throws Error on options out of range and
/// where there are more ranks than elements. Ranks make their own hexahedra.
NamedMesh MakeCurvedLayers(const LayersOptions &options, MPI_Comm comm);

} // namespace synovia
