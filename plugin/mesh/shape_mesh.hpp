#pragma once

#include "synovia/mesh/named_mesh.hpp"
#include "synovia/mesh/rigid_shape.hpp"

namespace synovia
{

/// A serial mesh with its names.
struct NamedSerialMesh
{
   mfem::Mesh mesh;
   NameTable regions;
   NameTable boundaries;
};

/// A thin layer of elements behind the surface: the region NAME with the
/// boundary NAME; of a cylinder also NAME_side and NAME_ends. The other side is
/// NAME_back. Throws Error, which names the shape, if sizes are not positive
/// or if a file can't be read; not collective.
NamedSerialMesh MeshShape(const RigidShape &shape);

/// The mesh with the shapes' layers behind its own elements, which share no
/// nodes with them. Throws Error if a name is taken. Not collective.
NamedSerialMesh AddShapes(const mfem::Mesh &mesh, const NameTable &regions,
                          const NameTable &boundaries,
                          const std::vector<RigidShape> &shapes);

} // namespace synovia
