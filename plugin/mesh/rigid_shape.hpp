#pragma once

#include "synovia/general/point3.hpp"

#include <string>

namespace synovia
{

/// What a rigid body without a mesh looks like from outside.
struct RigidShape
{
   enum class Type
   {
      none,
      /// A square.
      plane,
      sphere,
      /// A circular one, with flat ends.
      cylinder,
      /// A surface from a file: STL, or the triangles of an MSH file.
      file
   };

   /// Of the body's region and surface.
   std::string name;
   Type type = Type::none;
   /// Of the square, of the sphere, or of the middle of the cylinder's axis
   /// (length).
   Point3 center{{0.0, 0.0, 0.0}};
   /// The square's outward normal, or along the cylinder's axis; of any length.
   Point3 axis{{0.0, 0.0, 1.0}};
   /// Of the square, one of which is along the coordinate axis that is most at
   /// right angles to the normal, as seen along that (length).
   mfem::real_t edge = 1.0;
   /// Of sphere and cylinder (length).
   mfem::real_t radius = 1.0;
   /// Of the cylinder (length).
   mfem::real_t height = 1.0;
   /// Of a sphere or cylinder: its surface is the inner side of a hole.
   bool hollow = false;
   /// Size of the facets (length); 0: an eighth of the radius, a quarter of the
   /// edge. Facets of spheres and cylinders are curved.
   mfem::real_t facet_size = 0.0;
   /// Name of the file, and a factor on its coordinates.
   std::string file;
   mfem::real_t scale = 1.0;
};

} // namespace synovia
