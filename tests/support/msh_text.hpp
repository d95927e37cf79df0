#pragma once

#include <array>
#include <functional>
#include <string>
#include <vector>

namespace synovia
{

/// An ascii file of version 2.2 that no gmsh would write: the box [0,nx] x
/// [0,ny] x [0,nz] of unit hexahedra, all on one entity, with its outer faces
/// in the physical group 1.
struct MshText
{
   MshText(int nx, int ny, int nz);

   int nx;
   int ny;
   int nz;
   int first_node = 1;
   int first_element = 1;
   /// Adds a node far away that belongs to nothing.
   bool stray_node = false;
   /// Physical tag of an element.
   std::function<int(int, int, int)> region;
   /// Whether an element is numbered in the wrong sense.
   std::function<bool(int, int, int)> left_handed;
   /// Where a grid point is.
   std::function<std::array<double, 3>(int, int, int)> position;

   /// The number that the file gives to a grid point.
   int Node(int i, int j, int k) const;
   std::string Text() const;
};

/// The file, ascii of version 4.1, with all x negated.
std::string MirrorMsh(const std::string &text);

} // namespace synovia
