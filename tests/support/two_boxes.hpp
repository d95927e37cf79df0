#pragma once

#include "synovia/mesh/named_mesh.hpp"

namespace synovia
{

/// Two unit boxes that touch at z = 1 and share nothing: "lower" on
/// 0 <= z <= 1 and "upper" on 1 <= z <= 2, of 2 x 2 x 2 and 3 x 3 x 3 cells.
inline NamedMesh MakeTwoBoxes(mfem::Element::Type type)
{
   mfem::Mesh lower = mfem::Mesh::MakeCartesian3D(2, 2, 2, type);
   mfem::Mesh upper = mfem::Mesh::MakeCartesian3D(3, 3, 3, type);
   for (int i = 0; i < upper.GetNV(); i++)
   {
      upper.GetVertex(i)[2] += 1.0;
   }
   for (int i = 0; i < upper.GetNE(); i++)
   {
      upper.SetAttribute(i, 2);
   }
   for (int i = 0; i < upper.GetNBE(); i++)
   {
      upper.SetBdrAttribute(i, 6 + upper.GetBdrAttribute(i));
   }
   upper.SetAttributes();
   mfem::Mesh *boxes[] = {&lower, &upper};
   mfem::Mesh both(boxes, 2);
   return DistributeMesh(both, {{"lower", {1}}, {"upper", {2}}},
                         {{"lower_top", {6}}, {"upper_bottom", {7}}},
                         MPI_COMM_WORLD);
}

} // namespace synovia
