#pragma once

#include "mfem.hpp"

#include <ostream>
#include <string>
#include <utility>
#include <vector>

namespace synovia
{

/// A rank's part of a mesh with fields as a VTK file, with each node once.
///
/// MFEM writes the nodes of each element anew, which for tetrahedra of order 2
/// makes six times as many. Lagrange elements, binary.
class VtuPiece
{
public:
   /// Fields with the names that they get.
   using Fields =
      std::vector<std::pair<std::string, const mfem::ParGridFunction *>>;

   /// Borrows @a mesh, which must not change. @a order is the order of the
   /// elements in the file, @a compression zlib's level: -1 its default, 0
   /// none.
   VtuPiece(mfem::ParMesh &mesh, int order, int compression = -1);

   /// Writes the file. The fields must be continuous; any number of components.
   void Write(std::ostream &out, const Fields &fields) const;

private:
   const mfem::IntegrationRule &Points(int element) const;
   void NumberNodes();
   void EncodeMesh();
   /// The values of @a field at the nodes, component by component within each.
   std::vector<double> NodalValues(const mfem::ParGridFunction &field) const;

   mfem::ParMesh &mesh;
   int order;
   int compression;
   int node_count = 0;
   /// Where each element's nodes begin in nodes, and where the last one's end.
   std::vector<int> first;
   /// Numbers of the nodes at each element's Points().
   std::vector<int> nodes;
   /// Elements that have all nodes among them.
   std::vector<int> covering;
   /// The part of the file that says what the mesh is.
   std::string encoded_mesh;
};

} // namespace synovia
