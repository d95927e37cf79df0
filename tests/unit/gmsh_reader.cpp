// Meshes that gmsh saves are read with their volumes, surfaces and names.

// ranks: 1 2 3
// timeout: 300
// fixtures: gmsh_meshes

#include "support/gmsh_meshes.hpp"
#include "support/mesh_measures.hpp"
#include "support/msh_text.hpp"
#include "support/temporary_directory.hpp"
#include "synovia/mesh/flat_mesh.hpp"
#include "synovia/mesh/gmsh_file.hpp"
#include "synovia/mesh/named_mesh.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <iterator>
#include <map>

using namespace mfem;
using namespace synovia;

namespace
{

const real_t pi = 4.0 * std::atan(1.0);

NamedMesh Read(const std::string &model,
               const GmshFormat &format = GmshFormat(),
               const ReadOptions &options = ReadOptions())
{
   return ReadGmsh(GmshMesh(model, format), MPI_COMM_WORLD, options);
}

NamedMesh ReadMeshText(const std::string &text)
{
   const TemporaryDirectory directory;
   return ReadGmsh(directory.Write("mesh.msh", text), MPI_COMM_WORLD);
}

GmshFormat OfOrder(int order)
{
   GmshFormat format;
   format.order = order;
   return format;
}

std::vector<std::string> Keys(const NameTable &names)
{
   std::vector<std::string> keys;
   for (const auto &entry : names)
   {
      keys.push_back(entry.first);
   }
   return keys;
}

int NodalOrder(const NamedMesh &mesh)
{
   const GridFunction *const nodes = mesh.Get().GetNodes();
   return nodes ? nodes->FESpace()->GetMaxElementOrder() : 1;
}

// Where MFEM has a point of gmsh's element. Tetrahedra may be renumbered, so
// their points are found by their corners, the @a nodes in gmsh's order.
IntegrationPoint LocalPoint(const Element &element, const int *nodes,
                            const double (&local)[3])
{
   const auto [u, v, w] = local;
   IntegrationPoint point;
   switch (element.GetGeometryType())
   {
   case Geometry::CUBE:
      point.Set3((1 + u) / 2, (1 + v) / 2, (1 + w) / 2);
      break;
   case Geometry::PRISM:
      point.Set3(u, v, (1 + w) / 2);
      break;
   case Geometry::PYRAMID:
      point.Set3((1 + u - w) / 2, (1 + v - w) / 2, w);
      break;
   default:
      // Weights of gmsh's corners, handed to MFEM's corners.
      const double weights[4] = {1 - u - v - w, u, v, w};
      double mine[4] = {0.0, 0.0, 0.0, 0.0};
      for (int a = 0; a < 4; a++)
      {
         for (int b = 0; b < 4; b++)
         {
            mine[a] += element.GetVertices()[a] == nodes[b] ? weights[b] : 0.0;
         }
      }
      point.Set3(mine[1], mine[2], mine[3]);
   }
   return point;
}

// The largest distance between a point of an element in gmsh and the same point
// of the mesh that MFEM gets.
real_t LargestDistanceToGmsh(const std::string &model, const GmshFormat &format)
{
   const FlatMesh flat = ReadGmshFile(GmshMesh(model, format));
   const Mesh mesh = BuildMesh(flat);
   std::map<int, std::vector<GmshPoint>> points;
   for (const GmshPoint &point : GmshPoints(model, format))
   {
      points[point.element].push_back(point);
   }
   CHECK(mesh.GetNE() > 3);
   CHECK(static_cast<int>(points.size()) == mesh.GetNE());
   real_t largest = 0.0;
   int first = 0;
   for (int i = 0; i < mesh.GetNE(); i++)
   {
      IsoparametricTransformation map;
      mesh.GetElementTransformation(i, &map);
      const std::vector<GmshPoint> &theirs = points[flat.element_numbers[i]];
      REQUIRE(theirs.size() == std::size(gmsh_local_points));
      for (size_t p = 0; p < theirs.size(); p++)
      {
         Vector place(3);
         map.Transform(LocalPoint(*mesh.GetElement(i),
                                  &flat.element_nodes[first],
                                  gmsh_local_points[p]),
                       place);
         largest = std::max(largest, place.DistanceTo(theirs[p].place));
      }
      first += flat.shapes[flat.element_shapes[i]].nodes;
   }
   return largest;
}

const std::initializer_list<std::string> all_cells = {"tetrahedra", "hexahedra",
                                                      "prisms"};

// Largest and smallest distance from the origin of the nodal points of a
// boundary, over all ranks.
std::pair<real_t, real_t> RangeOfRadius(const NamedMesh &named,
                                        const std::string &boundary)
{
   const ParMesh &mesh = named.Get();
   const Array<int> attributes = named.Boundary(boundary);
   real_t range[2] = {-1e9, -1e9};
   for (int i = 0; i < mesh.GetNBE(); i++)
   {
      if (attributes.Find(mesh.GetBdrAttribute(i)) < 0)
      {
         continue;
      }
      IsoparametricTransformation map;
      mesh.GetBdrElementTransformation(i, &map);
      DenseMatrix positions;
      map.Transform(map.GetFE()->GetNodes(), positions);
      for (int j = 0; j < positions.Width(); j++)
      {
         const real_t radius =
            std::hypot(positions(0, j), positions(1, j), positions(2, j));
         range[0] = std::max(range[0], -radius);
         range[1] = std::max(range[1], radius);
      }
   }
   MPI_Allreduce(MPI_IN_PLACE, range, 2, MPITypeMap<real_t>::mpi_type, MPI_MAX,
                 named.GetComm());
   return {-range[0], range[1]};
}

} // namespace

// The box has the same measures whatever it is made and saved as.
TEST_CASE("gmsh reader: formats, elements and orders")
{
   const std::string cells = GENERATE(values<std::string>(all_cells));
   GmshFormat format;
   format.version = GENERATE(2.2, 4.1);
   format.binary = GENERATE(false, true);
   format.order = GENERATE(1, 2, 3);
   const NamedMesh mesh = Read("box_" + cells, format);

   CHECK(NodalOrder(mesh) == format.order);
   CHECK(mesh.Get().GetNE() > 0);
   CHECK(RegionVolume(mesh, "box") == Approx(6.0));
   CHECK(BoundaryArea(mesh, "bottom") == Approx(2.0));
   CHECK(BoundaryArea(mesh, "top") == Approx(2.0));
   CHECK(BoundaryArea(mesh, "sides") == Approx(18.0));
   CHECK(Keys(mesh.Regions()) == std::vector<std::string>{"box"});
   CHECK(Keys(mesh.Boundaries()) ==
         std::vector<std::string>{"bottom", "sides", "top"});
   CHECK(mesh.Boundary("sides")[0] == 3);
   CHECK(mesh.Get().bdr_attributes.Size() == 3);
}

// Each element of MFEM's mesh is the map that gmsh has for it, also inside.
TEST_CASE("gmsh reader: curved elements are gmsh's")
{
   GmshFormat format;
   SECTION("swept cylinders")
   {
      const std::string cells = GENERATE(values<std::string>(all_cells));
      format.order = GENERATE(1, 2, 3);
      format.serendipity = format.order == 2 && GENERATE(false, true);
      CHECK(LargestDistanceToGmsh("cylinder_" + cells + "_0.9", format) < 1e-9);
   }
   SECTION("a ball of order 4")
   {
      CHECK(LargestDistanceToGmsh("ball_1", OfOrder(4)) < 1e-9);
   }
   SECTION("bent pyramids")
   {
      format.order = GENERATE(1, 2);
      format.serendipity = GENERATE(false, true);
      CHECK(LargestDistanceToGmsh("pyramids", format) < 1e-9);
   }
}

// The first element gets nodes of its own between its corners.
TEST_CASE("gmsh reader: curved elements that do not fit together")
{
   FlatMesh flat = ReadGmshFile(GmshMesh("box_hexahedra", OfOrder(2)));
   REQUIRE(flat.element_shapes.size() > 1);
   CHECK(BuildMesh(flat).GetNE() > 1);
   for (int i = 8; i < flat.shapes[flat.element_shapes[0]].nodes; i++)
   {
      const int old = flat.element_nodes[i];
      flat.element_nodes[i] = static_cast<int>(flat.coordinates.size() / 3);
      for (int d = 0; d < 3; d++)
      {
         flat.coordinates.push_back(flat.coordinates[3 * old + d] + 0.01);
      }
   }
   CHECK_THROWS_WITH(BuildMesh(flat),
                     Catch::Contains("the curved elements do not fit "
                                     "together: element ") &&
                        Catch::Contains("save the mesh with elements of one "
                                        "order, and complete ones"));
}

TEST_CASE("gmsh reader: incomplete elements of order 3 are refused")
{
   GmshFormat format;
   format.order = 3;
   format.serendipity = true;
   CHECK_THROWS_WITH(Read("cylinder_hexahedra_0.9", format),
                     Catch::Contains("there is no element type 39, or it is "
                                     "not supported: complete elements are, "
                                     "and incomplete ones of order 2"));
}

// V = pi r^2 h. The error of a chord is of second order in the size, that of a
// parabola of fourth.
TEST_CASE("gmsh reader: the volume of a curved cylinder converges")
{
   const std::string cells = GENERATE(values<std::string>(all_cells));
   const auto error = [&](int order, const std::string &size)
   {
      const NamedMesh mesh =
         Read("cylinder_" + cells + "_" + size, OfOrder(order));
      return std::abs(RegionVolume(mesh, "cylinder") / (2 * pi) - 1.0);
   };
   CHECK(error(1, "0.4") > 1e-2);
   CHECK(error(2, "0.8") < 5e-3);
   CHECK(error(2, "0.4") < error(2, "0.8") / 8);

   const NamedMesh mesh = Read("cylinder_" + cells + "_0.4", OfOrder(2));
   CHECK(BoundaryArea(mesh, "mantle") == Approx(4 * pi).epsilon(1e-3));
   CHECK(BoundaryArea(mesh, "top") == Approx(pi).epsilon(1e-3));
   CHECK(mesh.Boundary("mantle")[0] == 13);
}

// gmsh puts the nodes on the sphere, and those of order 2 are MFEM's.
TEST_CASE("gmsh reader: the nodes of a ball lie on the sphere")
{
   const auto range = [](int order, const ReadOptions &options) {
      return RangeOfRadius(Read("ball_0.5", OfOrder(order), options), "sphere");
   };
   const auto second = range(2, ReadOptions());
   CHECK(second.first == Approx(1.0).margin(1e-10));
   CHECK(second.second == Approx(1.0).margin(1e-10));

   ReadOptions larger;
   larger.scale = 1000.0;
   CHECK(range(2, larger).second == Approx(1000.0).margin(1e-7));

   const auto third = range(3, ReadOptions());
   CHECK(third.first == Approx(1.0).margin(5e-4));
   CHECK(third.second == Approx(1.0).margin(5e-4));

   ReadOptions finer;
   finer.refine = 1;
   const auto split = range(2, finer);
   CHECK(split.first == Approx(1.0).margin(2e-3));
   CHECK(split.second == Approx(1.0).margin(2e-3));
}

TEST_CASE("gmsh reader: scale and refinement")
{
   const auto read = [](const ReadOptions &options)
   { return Read("box_hexahedra", GmshFormat(), options); };
   ReadOptions options;
   const NamedMesh as_it_is = read(options);
   options.scale = 10.0;
   options.refine = 1;
   const NamedMesh mesh = read(options);
   CHECK(mesh.Get().GetGlobalNE() == 8 * as_it_is.Get().GetGlobalNE());
   CHECK(RegionVolume(mesh, "box") == Approx(6000.0));
   CHECK(BoundaryArea(mesh, "top") == Approx(200.0));
}

// Bodies that touch without common nodes stay apart.
TEST_CASE("gmsh reader: two bodies")
{
   const NamedMesh mesh = Read("two_bodies");
   CHECK(RegionVolume(mesh, "lower") == Approx(1.0));
   CHECK(RegionVolume(mesh, "upper") == Approx(2.0));
   CHECK(BoundaryArea(mesh, "lower top") == Approx(1.0));
   CHECK(BoundaryArea(mesh, "upper bottom") == Approx(1.0));
   // The faces without a name are the others, under the next number.
   CHECK(BoundaryArea(mesh, "5") == Approx(14.0));
}

TEST_CASE("gmsh reader: groups that overlap")
{
   GmshFormat format;
   format.version = GENERATE(2.2, 4.1);
   format.binary = GENERATE(false, true);
   const NamedMesh mesh = Read("overlapping_groups", format);
   CHECK(RegionVolume(mesh, "small") == Approx(1.0));
   CHECK(RegionVolume(mesh, "all") == Approx(4.0));
   CHECK(mesh.Region("small").Size() == 1);
   CHECK(mesh.Region("all").Size() == 2);
   // All of the group 1 is in the group 2 as well.
   CHECK(mesh.Region("1")[0] == 3);
   CHECK(RegionVolume(mesh, "1") == Approx(1.0));
   CHECK(RegionVolume(mesh, "2") == Approx(4.0));
   CHECK(BoundaryArea(mesh, "ends") == Approx(2.0));
   CHECK(BoundaryArea(mesh, "7") == Approx(2.0));
   CHECK(BoundaryArea(mesh, "bottom") == Approx(1.0));
   CHECK(BoundaryArea(mesh, "9") == Approx(1.0));
   CHECK(BoundaryArea(mesh, "11") == Approx(3.0 + 14.0));
   CHECK(mesh.Get().GetGlobalNE() > 0);
}

// Where two regions share faces there is no boundary.
TEST_CASE("gmsh reader: surfaces between two regions")
{
   const NamedMesh mesh = Read("shared_face");
   CHECK(RegionVolume(mesh, "lower") == Approx(1.0));
   CHECK(BoundaryArea(mesh, "all") == Approx(10.0));
   CHECK(mesh.Boundaries().count("interface") == 1);
   CHECK_THROWS_WITH(mesh.Boundary("interface"),
                     "the boundary \"interface\" is empty: none of its faces "
                     "is on the outside of the mesh (bodies that touch need "
                     "nodes of their own); there are: all");
}

// gmsh can add to a file what nobody needs here.
TEST_CASE("gmsh reader: partitioned and parametric files")
{
   GmshFormat format;
   format.binary = GENERATE(false, true);
   const std::string model =
      GENERATE(values<std::string>({"parametric", "partitioned"}));
   const NamedMesh mesh = Read(model, format);
   CHECK(RegionVolume(mesh, "box") == Approx(6.0));
   CHECK(BoundaryArea(mesh, "sides") == Approx(18.0));
   CHECK(mesh.Get().bdr_attributes.Size() == 3);
}

// Other programs write one entity for everything and tell the regions apart by
// the physical tags of the elements alone.
TEST_CASE("gmsh reader: version 2 with one entity for all")
{
   MshText text(2, 2, 3);
   text.region = [](int, int, int k) { return k == 2 ? 20 : 10; };
   const NamedMesh mesh = ReadMeshText(text.Text());
   CHECK(RegionVolume(mesh, "10") == Approx(8.0));
   CHECK(RegionVolume(mesh, "20") == Approx(4.0));
}

// Numbers from somewhere, nodes of nothing, and Windows' ends of lines.
TEST_CASE("gmsh reader: untidy files")
{
   MshText text(2, 2, 2);
   text.first_node = 1000;
   text.first_element = 500000000;
   text.stray_node = true;
   SECTION("numbers and stray nodes")
   {
      const NamedMesh mesh = ReadMeshText(text.Text());
      CHECK(RegionVolume(mesh, "10") == Approx(8.0));
      long long vertices = 0;
      long long mine = mesh.Get().GetNE();
      MPI_Allreduce(&mine, &vertices, 1, MPI_LONG_LONG, MPI_SUM,
                    MPI_COMM_WORLD);
      CHECK(vertices == 8);
   }
   SECTION("ends of lines")
   {
      std::string windows;
      for (const char c : text.Text())
      {
         windows += c == '\n' ? "\r\n" : std::string(1, c);
      }
      CHECK(RegionVolume(ReadMeshText(windows), "10") == Approx(8.0));
   }
}

// Elements numbered in the wrong sense are turned, all or some of them.
TEST_CASE("gmsh reader: left-handed elements")
{
   MshText text(2, 2, 2);
   const bool all = GENERATE(false, true);
   text.left_handed = [&](int i, int j, int k)
   { return all || (i + j + k) % 2 == 0; };
   const NamedMesh mesh = ReadMeshText(text.Text());
   CHECK(RegionVolume(mesh, "10") == Approx(8.0));
   CHECK(BoundaryArea(mesh, "1") == Approx(24.0));
}

TEST_CASE("gmsh reader: left-handed curved elements")
{
   // In a mirror, gmsh's elements of any type are left-handed.
   const std::string cells = GENERATE(values<std::string>(all_cells));
   const std::string path = GmshMesh("cylinder_" + cells + "_0.7", OfOrder(2));
   const NamedMesh as_it_is = ReadGmsh(path, MPI_COMM_WORLD);
   const NamedMesh mirrored = ReadMeshText(MirrorMsh(ReadText(path)));
   CHECK(RegionVolume(mirrored, "cylinder") ==
         Approx(RegionVolume(as_it_is, "cylinder")));
   CHECK(BoundaryArea(mirrored, "mantle") ==
         Approx(BoundaryArea(as_it_is, "mantle")));
}
