#include "support/boxes.hpp"

#include <cmath>

namespace synovia
{

using namespace mfem;

Mesh MakeBoxMesh(const BoxOptions &options)
{
   Mesh mesh =
      Mesh::MakeCartesian3D(options.nx, options.ny, options.nz, options.type,
                            options.size_x, options.size_y, options.size_z);
   for (int i = 0; i < mesh.GetNV(); i++)
   {
      real_t &z = mesh.GetVertex(i)[2];
      const real_t s = 1.0 - z / options.size_z;
      z = options.size_z * (1.0 - std::pow(s, options.grading));
   }
   return mesh;
}

Mesh MakeStackMesh(const BoxOptions &lower, const BoxOptions &upper)
{
   Mesh low = MakeBoxMesh(lower);
   Mesh high = MakeBoxMesh(upper);
   for (int i = 0; i < high.GetNV(); i++)
   {
      high.GetVertex(i)[2] += lower.size_z;
   }
   for (int i = 0; i < high.GetNE(); i++)
   {
      high.SetAttribute(i, 2);
   }
   for (int i = 0; i < high.GetNBE(); i++)
   {
      high.SetBdrAttribute(i, high.GetBdrAttribute(i) + 6);
   }
   high.SetAttributes();
   Mesh *both[2] = {&low, &high};
   return Mesh(both, 2);
}

NamedMesh DistributeStack(Mesh &mesh, MPI_Comm comm, const int *partitioning)
{
   NameTable boundaries;
   const char *sides[6] = {"z0", "y0", "x1", "y1", "x0", "z1"};
   for (int i = 0; i < 6; i++)
   {
      boundaries[std::string("lower_") + sides[i]] = {i + 1};
      boundaries[std::string("upper_") + sides[i]] = {i + 7};
   }
   return DistributeMesh(mesh, {{"lower", {1}}, {"upper", {2}}}, boundaries,
                         comm, partitioning);
}

NamedMesh MakeStack(const BoxOptions &lower, const BoxOptions &upper,
                    const int *partitioning)
{
   Mesh mesh = MakeStackMesh(lower, upper);
   return DistributeStack(mesh, MPI_COMM_WORLD, partitioning);
}

NamedMesh MakeBox(const BoxOptions &options)
{
   Mesh mesh = MakeBoxMesh(options);
   return DistributeMesh(mesh, {{"body", {1}}},
                         {{"z0", {1}},
                          {"y0", {2}},
                          {"x1", {3}},
                          {"y1", {4}},
                          {"x0", {5}},
                          {"z1", {6}}},
                         MPI_COMM_WORLD);
}

} // namespace synovia
