#pragma once

#include "synovia/mesh/named_mesh.hpp"

#include <array>
#include <string>
#include <vector>

namespace synovia
{

/// A box with these names. The attributes of its sides are z0 1, y0 2, x1 3,
/// y1 4, x0 5, z1 6.
NamedMesh OneBox(const std::string &region, const NameTable &boundaries,
                 mfem::real_t size_x, mfem::real_t size_z);

/// Two boxes, one on the other, with these names. The attributes of the upper
/// one's sides are 6 more.
NamedMesh TwoBoxes(const std::string &lower_name, const std::string &upper_name,
                   const NameTable &boundaries, mfem::real_t lower_size,
                   mfem::real_t upper_size, mfem::real_t height = 0.75);

/// Any number of bodies, each a box or one that is bent.
class NamedBodies
{
public:
   /// @a sides are the names of z0, y0, x1, y1, x0 and z1.
   void Add(const std::string &region, mfem::Mesh mesh,
            const std::array<std::string, 6> &sides);

   NamedMesh Distribute() const;

private:
   struct Names
   {
      std::string region;
      std::array<std::string, 6> sides;
   };
   std::vector<mfem::Mesh> meshes;
   std::vector<Names> names;
};

/// A box with its middle above (x, y).
mfem::Mesh PlateMesh(mfem::real_t x, mfem::real_t y, mfem::real_t bottom,
                     mfem::real_t size, mfem::real_t height);

/// A box bent around (x, 0), radii 5 to 15, from one angle to another: x0 is
/// the inner side, y0 the end at the first angle.
mfem::Mesh ArcMesh(mfem::real_t x, mfem::real_t from, mfem::real_t to);

} // namespace synovia
