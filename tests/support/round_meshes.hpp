#pragma once

#include "synovia/mesh/named_mesh.hpp"

namespace synovia
{

/// A part of a ball or a cylinder as a core of cubes (squares) with shells
/// around it, in curved hexahedra.
struct RoundOptions
{
   mfem::real_t radius = 1.0;
   /// Half the side of the core / radius.
   mfem::real_t core_size = 0.5;
   /// Elements along an edge of the core.
   int core = 2;
   /// Layers of elements around the core.
   int shells = 3;
   /// Grading towards the surface: 1 is uniform, larger is finer there.
   mfem::real_t grading = 1.0;
   /// Order of the geometry.
   int order = 2;
   /// Of the cylinder.
   mfem::real_t height = 1.0;
   int layers = 1;
};

/// The quarter x, y >= 0 of the cylinder about the z axis: the region "body"
/// and the boundaries x0, y0, z0, z1 and "side".
NamedMesh MakeQuarterCylinder(const RoundOptions &options);

/// A part of a tube.
struct RingOptions
{
   mfem::real_t inner = 0.5;
   mfem::real_t outer = 1.0;
   mfem::real_t height = 1.0;
   /// Elements along the radius and around the axis.
   int across = 4;
   int around = 3;
   /// Grading towards the outside: 1 is uniform, larger is finer there.
   mfem::real_t grading = 1.0;
   /// Order of the geometry.
   int order = 2;
};

/// The quarter x, y >= 0 of the tube about the z axis, one layer of elements:
/// the region "body" and the boundaries x0, y0, z0, z1, "inside" and "outside".
NamedMesh MakeQuarterRing(const RingOptions &options);

/// The eighth x, y, z >= 0 of the ball: the region "body" and the boundaries
/// x0, y0, z0 and "surface".
NamedMesh MakeBallOctant(const RoundOptions &options);

} // namespace synovia
