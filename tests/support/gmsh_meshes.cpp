#include "support/gmsh_meshes.hpp"

#include <gmsh.h>

#include <cmath>
#include <fstream>
#include <iterator>

namespace synovia
{

namespace
{

// Surfaces of the model with their centers of mass at a height.
std::vector<int> SurfacesAt(double z)
{
   gmsh::vectorpair surfaces;
   gmsh::model::getEntities(surfaces, 2);
   std::vector<int> found;
   for (const auto &surface : surfaces)
   {
      double x = 0.0;
      double y = 0.0;
      double height = 0.0;
      gmsh::model::occ::getCenterOfMass(2, surface.second, x, y, height);
      if (std::abs(height - z) < 1e-6)
      {
         found.push_back(surface.second);
      }
   }
   return found;
}

void GroupAll(int dimension, int tag, const std::string &name)
{
   gmsh::vectorpair entities;
   gmsh::model::getEntities(entities, dimension);
   std::vector<int> tags;
   for (const auto &entity : entities)
   {
      tags.push_back(entity.second);
   }
   Group(dimension, tags, tag, name);
}

// What a sweep of a surface in z has made, with elements of the kind.
void Sweep(int surface, double height, int layers, Cells cells)
{
   gmsh::vectorpair swept;
   if (cells == Cells::tetrahedra)
   {
      gmsh::model::occ::extrude({{2, surface}}, 0, 0, height, swept);
   }
   else
   {
      gmsh::model::occ::extrude({{2, surface}}, 0, 0, height, swept, {layers},
                                {}, true);
   }
   gmsh::model::occ::synchronize();
   if (cells == Cells::hexahedra)
   {
      gmsh::model::mesh::setRecombine(2, surface);
   }
}

} // namespace

std::string SaveWithGmsh(const TemporaryDirectory &directory,
                         const GmshFormat &format,
                         const std::function<void()> &build)
{
   int rank = 0;
   MPI_Comm_rank(directory.GetComm(), &rank);
   const std::string path = directory / "mesh.msh";
   if (rank == 0)
   {
      gmsh::initialize(0, nullptr, false);
      const auto set = [](const std::string &name, double value)
      { gmsh::option::setNumber(name, value); };
      set("General.Terminal", 0.0);
      set("Mesh.MshFileVersion", format.version);
      set("Mesh.Binary", format.binary ? 1.0 : 0.0);
      set("Mesh.SecondOrderIncomplete", format.serendipity ? 1.0 : 0.0);
      build();
      std::vector<int> types;
      gmsh::model::mesh::getElementTypes(types, 3);
      if (types.empty())
      {
         gmsh::model::mesh::generate(3);
      }
      if (format.order > 1)
      {
         gmsh::model::mesh::setOrder(format.order);
      }
      gmsh::write(path);
      gmsh::finalize();
   }
   MPI_Barrier(directory.GetComm());
   return path;
}

std::string SavedText(const TemporaryDirectory &directory,
                      const GmshFormat &format,
                      const std::function<void()> &build)
{
   std::ifstream stream(SaveWithGmsh(directory, format, build),
                        std::ios::binary);
   return std::string(std::istreambuf_iterator<char>(stream),
                      std::istreambuf_iterator<char>());
}

void Group(int dimension, const std::vector<int> &entities, int tag,
           const std::string &name)
{
   gmsh::model::addPhysicalGroup(dimension, entities, tag);
   gmsh::model::setPhysicalName(dimension, tag, name);
}

void BuildBox(Cells cells)
{
   gmsh::option::setNumber("Mesh.MeshSizeMax", 1.0);
   const int base = gmsh::model::occ::addRectangle(0, 0, 0, 1, 2);
   gmsh::model::occ::synchronize();
   if (cells == Cells::hexahedra)
   {
      gmsh::model::mesh::setTransfiniteSurface(base);
   }
   Sweep(base, 3.0, 3, cells);
   Group(2, SurfacesAt(0.0), 1, "bottom");
   Group(2, SurfacesAt(3.0), 2, "top");
   Group(2, SurfacesAt(1.5), 3, "sides");
   GroupAll(3, 1, "box");
}

void BuildCylinder(Cells cells, double size)
{
   gmsh::option::setNumber("Mesh.MeshSizeMax", size);
   gmsh::option::setNumber("Mesh.MeshSizeMin", size);
   const int base = gmsh::model::occ::addDisk(0, 0, 0, 1, 1);
   Sweep(base, 2.0, static_cast<int>(std::ceil(2.0 / size)), cells);
   Group(2, SurfacesAt(0.0), 11, "bottom");
   Group(2, SurfacesAt(2.0), 12, "top");
   Group(2, SurfacesAt(1.0), 13, "mantle");
   GroupAll(3, 21, "cylinder");
}

void BuildBall(double size)
{
   gmsh::option::setNumber("Mesh.MeshSizeMax", size);
   gmsh::option::setNumber("Mesh.MeshSizeMin", size);
   gmsh::model::occ::addSphere(0, 0, 0, 1);
   gmsh::model::occ::synchronize();
   GroupAll(2, 5, "sphere");
   GroupAll(3, 4, "ball");
}

void BuildPyramids()
{
   const int volume = gmsh::model::addDiscreteEntity(3);
   const std::vector<double> corners = {0, 0, 0, 1, 0, 0, 1,   1,   0,
                                        0, 1, 0, 0, 0, 1, 1,   0,   1,
                                        1, 1, 1, 0, 1, 1, 0.5, 0.5, 0.5};
   gmsh::model::mesh::addNodes(3, volume, {1, 2, 3, 4, 5, 6, 7, 8, 9}, corners);
   const std::vector<std::size_t> pyramids = {1, 2, 3, 4, 9, 8, 7, 6, 5, 9,
                                              1, 5, 6, 2, 9, 2, 6, 7, 3, 9,
                                              3, 7, 8, 4, 9, 4, 8, 5, 1, 9};
   const int pyramid = gmsh::model::mesh::getElementType("Pyramid", 1);
   gmsh::model::mesh::addElementsByType(volume, pyramid, {1, 2, 3, 4, 5, 6},
                                        pyramids);
   GroupAll(3, 1, "cube");
}

} // namespace synovia
