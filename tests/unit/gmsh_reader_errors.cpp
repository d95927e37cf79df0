// Whatever is wrong with a mesh file is told on all ranks, by name and place.

// ranks: 1 2 3
// timeout: 300
// fixtures: gmsh_meshes

#include "support/gmsh_meshes.hpp"
#include "support/msh_text.hpp"
#include "support/temporary_directory.hpp"
#include "synovia/general/error.hpp"
#include "synovia/mesh/named_mesh.hpp"

#include <catch2/catch.hpp>

#include <algorithm>

using namespace mfem;
using namespace synovia;

namespace
{

std::string Replace(std::string text, const std::string &old,
                    const std::string &fresh)
{
   const size_t at = text.find(old);
   REQUIRE(at != std::string::npos);
   return text.replace(at, old.size(), fresh);
}

// The text of the error, after the name of the file.
std::string ErrorOf(const TemporaryDirectory &directory,
                    const std::string &text,
                    const ReadOptions &options = ReadOptions())
{
   const std::string path = directory.Write("bad.msh", text);
   const std::string start = "mesh \"" + path + "\": ";
   std::string message;
   try
   {
      ReadGmsh(path, MPI_COMM_WORLD, options);
   }
   catch (const Error &error)
   {
      message = error.what();
   }
   CHECK(message.substr(0, start.size()) == start);
   return message.substr(std::min(start.size(), message.size()));
}

std::string ErrorOfModel(const std::string &model)
{
   const TemporaryDirectory directory;
   return ErrorOf(directory, ReadText(GmshMesh(model)));
}

} // namespace

TEST_CASE("gmsh reader errors: no file")
{
   const TemporaryDirectory directory;
   const std::string missing = directory / "nothing.msh";
   CHECK_THROWS_WITH(ReadGmsh(missing, MPI_COMM_WORLD),
                     "mesh \"" + missing + "\": there is no such file");
   const std::string place = directory / "";
   CHECK_THROWS_WITH(ReadGmsh(place, MPI_COMM_WORLD),
                     "mesh \"" + place + "\": this is a directory");
   CHECK(ErrorOf(directory, "") == "the file is empty");
}

TEST_CASE("gmsh reader errors: something else than a mesh")
{
   const TemporaryDirectory directory;
   const std::string no_mesh =
      "this is no gmsh mesh: it does not start with $MeshFormat; let gmsh "
      "convert it with -save -o NAME.msh, and mesh a geometry first";
   CHECK(ErrorOf(directory, "Point(1) = {0, 0, 0};\n") == no_mesh);
   CHECK(ErrorOf(directory, std::string(1000, '\0')) == no_mesh);
   CHECK(ErrorOf(directory, "$Nodes\n0\n$EndNodes\n") ==
         "the section $MeshFormat must come first (line 2)");
   CHECK(ErrorOf(directory, "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n") ==
         "the section $Nodes is missing (line 4)");
   CHECK(ErrorOf(directory, "$MeshFormat\n4 0 8\n$EndMeshFormat\n") ==
         "MSH version 4 is not supported; let gmsh convert the file with -save "
         "-format msh41 -o NAME.msh (line 2)");
}

TEST_CASE("gmsh reader errors: options")
{
   const TemporaryDirectory directory;
   const std::string text = MshText(1, 1, 1).Text();
   ReadOptions options;
   options.scale = 0.0;
   CHECK(ErrorOf(directory, text, options) ==
         "the scale is 0; it must be positive");
   options.scale = 1.0;
   options.refine = -1;
   CHECK(ErrorOf(directory, text, options) ==
         "the mesh cannot be refined -1 times");
}

TEST_CASE("gmsh reader errors: damaged text")
{
   const TemporaryDirectory directory;
   const std::string text = MshText(2, 1, 1).Text();
   const auto error = [&](const std::string &old, const std::string &fresh)
   { return ErrorOf(directory, Replace(text, old, fresh)); };
   CHECK(error("\n2 1 0 0\n", "\n2 1 0 zero\n") ==
         "expected a number, found \"zero\" (line 7)");
   CHECK(error("\n2 1 0 0\n", "\n2 1 0\n") ==
         "expected a number, found \"$EndNodes\" (line 18)");
   CHECK(error("\n2 1 0 0\n", "\n22222222222 1 0 0\n") ==
         "the number 22222222222 is too large (line 7)");
   CHECK(error("$EndNodes", "$EndNods") ==
         "expected $EndNodes, found \"$EndNods\" (line 18)");
   CHECK(error("$Nodes\n12", "$Nodes\n11") ==
         "expected $EndNodes, found \"12\" (line 17)");
   CHECK(error(" 5 2 10 1 ", " 5000 2 10 1 ") ==
         "there is no element type 5000, or it is not supported: complete "
         "elements are, and incomplete ones of order 2 (line 26)");
   CHECK(error(" 5 2 10 1 ", " 5 2 2147483647 1 ") ==
         "the physical tag 2147483647 is beyond 10000000 (line 26)");
   CHECK(error("\n2 1 0 0\n", "\n2 nan 0 0\n") ==
         "node 2 has a coordinate that is not finite (line 7)");
   CHECK(error("\n6 5 2 10 1 1 ", "\n6 5 2 10 1 99 ") ==
         "element 6 has the node 99, which does not exist (line 26)");
   CHECK(error("\n2 1 0 0\n", "\n3 1 0 0\n") ==
         "there are two nodes with the number 3 (line 17)");
   CHECK(error("\n6 5 2 10 1 1 ", "\n6 5 2 10 1 2 ") ==
         "element 6 has the same node at two corners");
   CHECK(error("\n6 5 2 10 1 1 ", "\n6 8 2 10 1 1 ") != "");
}

// Wherever the file ends too soon, the reader says so.
TEST_CASE("gmsh reader errors: files that are cut off")
{
   GmshFormat format;
   format.version = GENERATE(2.2, 4.1);
   format.binary = GENERATE(false, true);
   const TemporaryDirectory directory;
   const std::string text = ReadText(GmshMesh("box_hexahedra", format));
   const size_t end = text.find("$EndElements");
   REQUIRE(end != std::string::npos);
   for (size_t i = 1; i < 40; i++)
   {
      const size_t length = end * i / 40;
      CAPTURE(length);
      CHECK(ErrorOf(directory, text.substr(0, length)) != "");
   }
   CHECK_THAT(ErrorOf(directory, text.substr(0, end)),
              Catch::Contains("the file is cut off"));
}

// Every byte matters to the sections that the reader looks at. It may take a
// damaged mesh for a good one, but comes back.
TEST_CASE("gmsh reader errors: files with damaged bytes")
{
   GmshFormat format;
   format.version = GENERATE(2.2, 4.1);
   format.binary = GENERATE(false, true);
   const TemporaryDirectory directory;
   const std::string text = ReadText(GmshMesh("box_prisms", format));
   const char damage = GENERATE('\xff', '\0', '7');
   for (size_t i = 0; i < 40; i++)
   {
      std::string damaged = text;
      damaged[text.size() * (2 * i + 1) / 80] = damage;
      const std::string path = directory.Write("bad.msh", damaged);
      std::string message;
      long long elements = 0;
      try
      {
         elements = ReadGmsh(path, MPI_COMM_WORLD).Get().GetGlobalNE();
      }
      catch (const Error &error)
      {
         message = error.what();
      }
      CAPTURE(i, message);
      CHECK((elements > 0) == message.empty());
   }
}

TEST_CASE("gmsh reader errors: no volume")
{
   CHECK_THAT(ErrorOfModel("square"),
              Catch::StartsWith("the mesh has no volume elements, but ") &&
                 Catch::EndsWith(" surface elements; is it two-dimensional, or "
                                 "are only its surfaces in physical groups?"));
   CHECK_THAT(ErrorOfModel("hollow_ball"),
              Catch::StartsWith("the mesh has no volume elements, but "));
}

TEST_CASE("gmsh reader errors: volumes without a group")
{
   CHECK_THAT(ErrorOfModel("ball_without_groups"),
              Catch::Contains("volume elements are in no physical group; the "
                              "first is element ") &&
                 Catch::EndsWith(" of volume 1; put every volume into a "
                                 "physical group"));
   MshText text(2, 1, 1);
   text.region = [](int i, int, int) { return i == 1 ? 0 : 10; };
   const TemporaryDirectory directory;
   CHECK(ErrorOf(directory, text.Text()) ==
         "1 of the 2 volume elements are in no physical group; the first is "
         "element 12 of volume 1; put every volume into a physical group");
}

TEST_CASE("gmsh reader errors: a surface without a volume")
{
   CHECK_THAT(ErrorOfModel("ball_and_plate"),
              Catch::Contains(" surface elements are no face of a volume "
                              "element; the first is element ") &&
                 Catch::EndsWith(" in the physical surface \"plate\"; is a "
                                 "volume missing, or does the surface not "
                                 "belong to the mesh?"));
}

// A node is moved through the opposite face of the elements around it.
TEST_CASE("gmsh reader errors: tangled elements")
{
   MshText text(2, 2, 4);
   text.first_element = 100;
   text.region = [](int, int, int k) { return k < 2 ? 10 : 20; };
   text.position = [](int i, int j, int k)
   {
      const bool moved = i == 1 && j == 1 && k == 3;
      return std::array<double, 3>{1.0 * i, 1.0 * j, moved ? 1.5 : 1.0 * k};
   };
   const TemporaryDirectory directory;
   const std::string message = ErrorOf(directory, text.Text());
   CHECK(message ==
         "4 elements are tangled (the Jacobian determinant is not positive "
         "everywhere); the first is element 130 in region \"20\", around (0.5, "
         "0.5, 2.3125)");

   // One of them turned inside out altogether is found all the same.
   MshText inverted(3, 3, 3);
   inverted.position = [](int i, int j, int k)
   {
      const bool inner = i > 0 && i < 3 && j > 0 && j < 3 && k > 0 && k < 3;
      return std::array<double, 3>{inner ? 3.0 - i : 1.0 * i, 1.0 * j, 1.0 * k};
   };
   CHECK_THAT(ErrorOf(directory, inverted.Text()),
              Catch::Contains(" elements are tangled"));
}

TEST_CASE("gmsh reader errors: damaged topology")
{
   // The faces of two boxes: the second one's are the first one's, crossed.
   const TemporaryDirectory directory;
   std::string text = MshText(2, 1, 1).Text();
   const size_t second = text.rfind(" 5 2 10 1 ");
   REQUIRE(second != std::string::npos);
   const size_t end = text.find('\n', second);
   text.replace(second, end - second, " 5 2 10 1 2 3 9 5 11 12 6 8");
   CHECK_THAT(ErrorOf(directory, text),
              Catch::Contains("share the corners of a face but not its edges"));

   const auto element = [](int number, int last)
   {
      return std::to_string(number) + " 4 2 1 1 1 2 3 " + std::to_string(last) +
             "\n";
   };
   const std::string three =
      "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n6\n1 0 0 0\n2 1 0 0\n"
      "3 0 1 0\n4 0 0 1\n5 0 0 -1\n6 1 1 1\n$EndNodes\n$Elements\n3\n" +
      element(1, 4) + element(2, 5) + element(3, 6) + "$EndElements\n";
   CHECK(ErrorOf(directory, three) == "the elements 1, 2 and 3 share one face");
}

TEST_CASE("gmsh reader errors: more ranks than elements")
{
   int ranks = 1;
   MPI_Comm_size(MPI_COMM_WORLD, &ranks);
   const TemporaryDirectory directory;
   const std::string text = MshText(1, 1, 1).Text();
   if (ranks > 1)
   {
      CHECK(ErrorOf(directory, text) ==
            "there are " + std::to_string(ranks) +
               " ranks and only 1 elements; use fewer ranks or refine the "
               "mesh");
   }
   ReadOptions options;
   options.refine = 1;
   const std::string path = directory.Write("good.msh", text);
   const NamedMesh mesh = ReadGmsh(path, MPI_COMM_WORLD, options);
   CHECK(mesh.Get().GetGlobalNE() == 8);
}
