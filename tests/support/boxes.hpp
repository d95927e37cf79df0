#pragma once

#include "synovia/mesh/named_mesh.hpp"

namespace synovia
{

/// A box [0, size]^3 of nx x ny x nz cells with the region "body" and the
/// boundaries x0, x1, y0, y1, z0, z1.
struct BoxOptions
{
   int nx = 1;
   int ny = 1;
   int nz = 4;
   mfem::Element::Type type = mfem::Element::HEXAHEDRON;
   mfem::real_t size_x = 1.0;
   mfem::real_t size_y = 1.0;
   mfem::real_t size_z = 1.0;
   /// Grading towards z1: 1 is uniform, larger is finer at the top.
   mfem::real_t grading = 1.0;
};

mfem::Mesh MakeBoxMesh(const BoxOptions &options);
NamedMesh MakeBox(const BoxOptions &options);

/// Two boxes, the upper one on top of the lower one without common nodes: the
/// regions "lower" and "upper", the boundaries lower_x0, ..., upper_z1. The
/// attributes of the upper box are those of the lower one plus 1 (region) and
/// plus 6 (boundaries).
mfem::Mesh MakeStackMesh(const BoxOptions &lower, const BoxOptions &upper);
NamedMesh MakeStack(const BoxOptions &lower, const BoxOptions &upper,
                    const int *partitioning = nullptr);

/// Distributes what MakeStackMesh() made, perhaps bent or moved since.
NamedMesh DistributeStack(mfem::Mesh &mesh, MPI_Comm comm,
                          const int *partitioning = nullptr);

} // namespace synovia
