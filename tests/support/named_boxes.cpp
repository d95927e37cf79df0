#include "support/named_boxes.hpp"
#include "support/boxes.hpp"
#include "synovia/mesh/stack_bodies.hpp"

#include <cmath>

namespace synovia
{

using namespace mfem;

NamedMesh OneBox(const std::string &region, const NameTable &boundaries,
                 real_t size_x, real_t size_z)
{
   BoxOptions box;
   box.nx = 3;
   box.nz = 2;
   box.size_x = size_x;
   box.size_y = size_x;
   box.size_z = size_z;
   Mesh mesh = MakeBoxMesh(box);
   return DistributeMesh(mesh, {{region, {1}}}, boundaries, MPI_COMM_WORLD);
}

NamedMesh TwoBoxes(const std::string &lower_name, const std::string &upper_name,
                   const NameTable &boundaries, real_t lower_size,
                   real_t upper_size, real_t height)
{
   BoxOptions lower;
   lower.nx = 2;
   lower.nz = 2;
   lower.size_x = lower_size;
   lower.size_y = lower_size;
   lower.size_z = height;
   BoxOptions upper = lower;
   upper.size_x = upper_size;
   upper.size_y = upper_size;
   Mesh mesh = MakeStackMesh(lower, upper);
   return DistributeMesh(mesh, {{lower_name, {1}}, {upper_name, {2}}},
                         boundaries, MPI_COMM_WORLD);
}

void NamedBodies::Add(const std::string &region, Mesh mesh,
                      const std::array<std::string, 6> &sides)
{
   meshes.push_back(std::move(mesh));
   names.push_back({region, sides});
}

NamedMesh NamedBodies::Distribute() const
{
   std::vector<const Mesh *> borrowed;
   for (const Mesh &mesh : meshes)
   {
      borrowed.push_back(&mesh);
   }
   StackedBodies all = StackBodies(borrowed);
   NameTable regions;
   NameTable boundaries;
   for (size_t i = 0; i < names.size(); i++)
   {
      regions[names[i].region] = {1 + all.region_offsets[i]};
      for (int side = 0; side < 6; side++)
      {
         boundaries[names[i].sides[side]].push_back(1 + side +
                                                    all.boundary_offsets[i]);
      }
   }
   return DistributeMesh(all.mesh, regions, boundaries, MPI_COMM_WORLD);
}

Mesh PlateMesh(real_t x, real_t y, real_t bottom, real_t size, real_t height)
{
   BoxOptions box;
   box.nx = 2;
   box.nz = 2;
   box.size_x = size;
   box.size_y = size;
   box.size_z = height;
   Mesh mesh = MakeBoxMesh(box);
   for (int i = 0; i < mesh.GetNV(); i++)
   {
      real_t *const vertex = mesh.GetVertex(i);
      vertex[0] += x - 0.5 * size;
      vertex[1] += y - 0.5 * size;
      vertex[2] += bottom;
   }
   return mesh;
}

Mesh ArcMesh(real_t x, real_t from, real_t to)
{
   BoxOptions box;
   box.ny = 4;
   box.nz = 1;
   Mesh mesh = MakeBoxMesh(box);
   for (int i = 0; i < mesh.GetNV(); i++)
   {
      real_t *const vertex = mesh.GetVertex(i);
      const real_t radius = 5.0 + 10.0 * vertex[0];
      const real_t angle = from + (to - from) * vertex[1];
      vertex[0] = x + radius * std::cos(angle);
      vertex[1] = radius * std::sin(angle);
      vertex[2] *= 2.0;
   }
   return mesh;
}

} // namespace synovia
