#pragma once

#include "synovia/general/point3.hpp"

#include "mfem.hpp"

#include <vector>

namespace synovia
{

/// A surface with a thickness: facets of three or four corners, and for each
/// corner its place on the surface and the one below it.
struct SurfaceSheet
{
   struct Facet
   {
      /// Counter-clockwise as seen from outside; -1 is the fourth of a
      /// triangle.
      std::array<int, 4> corners;
      /// Boundary attribute of the outer side.
      int attribute;
   };

   std::vector<Point3> outer;
   std::vector<Point3> inner;
   std::vector<Facet> facets;

   /// Adds a corner; gives its number.
   int Add(const Point3 &on_surface, const Point3 &below);
   void AddTriangle(int a, int b, int c, int attribute = 1);
   void AddQuadrilateral(int a, int b, int c, int d, int attribute = 1);
};

/// One layer of prisms and hexahedra between both sides, with the attribute 1.
/// Boundary faces other than the outer ones have the attribute @a back.
mfem::Mesh MakeLayer(const SurfaceSheet &sheet, int back);

} // namespace synovia
