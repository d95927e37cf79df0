// ranks: 1
//
// Layers behind the surfaces of rigid bodies without a mesh: area, place and
// orientation of the surface; facets from files, and what is wrong with them.

#include "synovia/mesh/shape_mesh.hpp"
#include "support/temporary_directory.hpp"
#include "synovia/general/error.hpp"
#include "synovia/mesh/element_measure.hpp"

#include <catch2/catch.hpp>

#include <cstdint>
#include <fstream>

using namespace mfem;
using namespace synovia;

namespace
{
RigidShape Shape(RigidShape::Type type)
{
   RigidShape shape;
   shape.name = "it";
   shape.type = type;
   shape.center = {1.0, 2.0, 3.0};
   shape.axis = {1.0, 1.0, 0.5};
   shape.radius = 2.0;
   shape.height = 3.0;
   shape.edge = 1.5;
   return shape;
}

struct Surface
{
   real_t area = 0.0;
   /// Integrals of normal and of x.n over the surface, x from a point.
   Point3 normal{{0.0, 0.0, 0.0}};
   real_t flow = 0.0;
};

Surface Measure(NamedSerialMesh &shape, const std::string &name,
                const Point3 &from)
{
   Surface sums;
   const std::vector<int> &attributes = shape.boundaries.at(name);
   Vector normal(3);
   Vector x(3);
   for (int i = 0; i < shape.mesh.GetNBE(); i++)
   {
      if (std::find(attributes.begin(), attributes.end(),
                    shape.mesh.GetBdrAttribute(i)) == attributes.end())
      {
         continue;
      }
      ElementTransformation &map = *shape.mesh.GetBdrElementTransformation(i);
      for (const IntegrationPoint &ip : IntRules.Get(map.GetGeometryType(), 8))
      {
         map.SetIntPoint(&ip);
         CalcOrtho(map.Jacobian(), normal);
         map.Transform(ip, x);
         sums.area += ip.weight * normal.Norml2();
         for (int d = 0; d < 3; d++)
         {
            sums.normal[d] += ip.weight * normal[d];
            sums.flow += ip.weight * normal[d] * (x[d] - from[d]);
         }
      }
   }
   return sums;
}

bool IsSound(Mesh &mesh)
{
   for (int i = 0; i < mesh.GetNE(); i++)
   {
      if (!(synovia::Measure(*mesh.GetElementTransformation(i)) > 0.0))
      {
         return false;
      }
   }
   return true;
}
} // namespace

TEST_CASE("A plane faces along its normal")
{
   const RigidShape plane = Shape(RigidShape::Type::plane);
   NamedSerialMesh mesh = MeshShape(plane);
   CHECK(IsSound(mesh.mesh));
   const Surface all = Measure(mesh, "it", plane.center);
   CHECK(all.area == Approx(1.5 * 1.5));
   CHECK(std::abs(all.flow) < 1e-12);
   for (int d = 0; d < 3; d++)
   {
      CHECK(all.normal[d] == Approx(1.5 * 1.5 * plane.axis[d] / 1.5));
   }
}

TEST_CASE("A sphere has the area of one, and faces outward or inward")
{
   const bool hollow = GENERATE(false, true);
   RigidShape sphere = Shape(RigidShape::Type::sphere);
   sphere.hollow = hollow;
   NamedSerialMesh mesh = MeshShape(sphere);
   CHECK(IsSound(mesh.mesh));
   const Surface all = Measure(mesh, "it", sphere.center);
   CHECK(all.area == Approx(16.0 * M_PI).epsilon(1e-5));
   CHECK(Length(all.normal) < 1e-8);
   CHECK(all.flow == Approx((hollow ? -32.0 : 32.0) * M_PI).epsilon(1e-5));
}

TEST_CASE("A cylinder has a side and two ends")
{
   RigidShape cylinder = Shape(RigidShape::Type::cylinder);
   NamedSerialMesh mesh = MeshShape(cylinder);
   CHECK(IsSound(mesh.mesh));
   const Surface side = Measure(mesh, "it_side", cylinder.center);
   const Surface ends = Measure(mesh, "it_ends", cylinder.center);
   const Surface all = Measure(mesh, "it", cylinder.center);
   CHECK(side.area == Approx(12.0 * M_PI).epsilon(1e-5));
   CHECK(side.flow == Approx(24.0 * M_PI).epsilon(1e-5));
   CHECK(ends.area == Approx(8.0 * M_PI).epsilon(1e-5));
   CHECK(ends.flow == Approx(12.0 * M_PI).epsilon(1e-5));
   CHECK(all.area == Approx(side.area + ends.area));
   CHECK(Length(all.normal) < 1e-8);
   cylinder.hollow = true;
   NamedSerialMesh bore = MeshShape(cylinder);
   CHECK(IsSound(bore.mesh));
   CHECK(Measure(bore, "it", cylinder.center).flow ==
         Approx(-24.0 * M_PI).epsilon(1e-5));
   CHECK(bore.boundaries.count("it_ends") == 0);
}

namespace
{
// A tetrahedron, three edges of which are along the axes.
const std::vector<std::array<Point3, 3>> &Facets()
{
   static const Point3 o{{0, 0, 0}}, x{{2, 0, 0}}, y{{0, 2, 0}}, z{{0, 0, 2}};
   static const std::vector<std::array<Point3, 3>> facets{
      {{o, y, x}}, {{o, x, z}}, {{o, z, y}}, {{x, y, z}}};
   return facets;
}

void WriteAscii(const std::string &file)
{
   std::ofstream out(file);
   out << "solid it\n";
   for (const auto &facet : Facets())
   {
      out << "facet normal 0 0 0\nouter loop\n";
      for (const Point3 &p : facet)
      {
         out << "vertex " << p[0] << ' ' << p[1] << ' ' << p[2] << '\n';
      }
      out << "endloop\nendfacet\n";
   }
   out << "endsolid it\n";
}

void WriteBinary(const std::string &file)
{
   std::ofstream out(file, std::ios::binary);
   out << std::string(80, ' ');
   const std::uint32_t count = static_cast<std::uint32_t>(Facets().size());
   out.write(reinterpret_cast<const char *>(&count), sizeof(count));
   for (const auto &facet : Facets())
   {
      float numbers[12] = {};
      for (int k = 0; k < 9; k++)
      {
         numbers[3 + k] = static_cast<float>(facet[k / 3][k % 3]);
      }
      out.write(reinterpret_cast<const char *>(numbers), sizeof(numbers));
      out << std::string(2, '\0');
   }
}

void WriteMsh(const std::string &file)
{
   std::ofstream out(file);
   out << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n12\n";
   int node = 0;
   for (const auto &facet : Facets())
   {
      for (const Point3 &p : facet)
      {
         out << ++node << ' ' << p[0] << ' ' << p[1] << ' ' << p[2] << '\n';
      }
   }
   out << "$EndNodes\n$Elements\n4\n";
   for (int i = 0; i < 4; i++)
   {
      out << i + 1 << " 2 2 1 1 " << 3 * i + 1 << ' ' << 3 * i + 2 << ' '
          << 3 * i + 3 << '\n';
   }
   out << "$EndElements\n";
}
} // namespace

TEST_CASE("Surfaces come from STL and MSH files")
{
   const TemporaryDirectory directory(MPI_COMM_WORLD);
   RigidShape shape = Shape(RigidShape::Type::file);
   shape.file = directory.Path() + "/it.stl";
   shape.scale = 0.5;
   const int kind = GENERATE(0, 1, 2);
   CAPTURE(kind);
   kind == 0   ? WriteAscii(shape.file)
   : kind == 1 ? WriteBinary(shape.file)
               : WriteMsh(shape.file);
   NamedSerialMesh mesh = MeshShape(shape);
   CHECK(mesh.mesh.GetNE() == 4);
   CHECK(mesh.mesh.GetNV() == 8);
   const Surface all = Measure(mesh, "it", {{0.0, 0.0, 0.0}});
   CHECK(all.area == Approx(1.5 + std::sqrt(3.0) / 2.0));
   CHECK(all.flow == Approx(0.5));
}

TEST_CASE("What is wrong with a shape is said with its name")
{
   const TemporaryDirectory directory(MPI_COMM_WORLD);
   RigidShape shape = Shape(RigidShape::Type::file);
   shape.file = directory.Path() + "/it.stl";
   CHECK_THROWS_WITH(MeshShape(shape), Catch::Contains("the shape of \"it\"") &&
                                          Catch::Contains("cannot be read"));
   std::ofstream(shape.file) << "solid nothing\nendsolid\n";
   CHECK_THROWS_WITH(MeshShape(shape), Catch::Contains("it has no facets"));
   std::ofstream(shape.file) << "vertex 1 2 x\n";
   CHECK_THROWS_WITH(MeshShape(shape), Catch::Contains("no three numbers"));
   std::ofstream(shape.file)
      << "vertex 0 0 0 vertex 1 0 0 vertex 0 1 0 endfacet\n"
         "vertex 0 0 0 vertex 1 0 0 vertex 0 0 1 endfacet\n";
   CHECK_THROWS_WITH(MeshShape(shape), Catch::Contains("meet in an edge"));
   shape = Shape(RigidShape::Type::sphere);
   shape.radius = -1.0;
   CHECK_THROWS_WITH(MeshShape(shape), Catch::Contains("the radius is -1"));
   shape.radius = 1.0;
   shape.facet_size = 1e-5;
   CHECK_THROWS_WITH(MeshShape(shape), Catch::Contains("too small"));
}

TEST_CASE("A shape's names are not those of the mesh")
{
   const Mesh box = Mesh::MakeCartesian3D(1, 1, 1, Element::HEXAHEDRON);
   const RigidShape plane = Shape(RigidShape::Type::plane);
   const NamedSerialMesh all =
      AddShapes(box, {{"box", {1}}}, {{"top", {6}}}, {plane});
   CHECK(all.regions.at("it") == std::vector<int>{2});
   CHECK(all.boundaries.at("it") == std::vector<int>{7});
   CHECK(all.mesh.GetAttribute(0) == 1);
   CHECK_THROWS_WITH(AddShapes(box, {{"it", {1}}}, {}, {plane}),
                     Catch::Contains("of a name that the mesh has already"));
}
