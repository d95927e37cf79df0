// ranks: 1 2 3

#include "synovia/io/paraview_output.hpp"
#include "support/boxes.hpp"
#include "support/temporary_directory.hpp"
#include "synovia/general/error.hpp"
#include "synovia/io/vtu_piece.hpp"

#include <catch2/catch.hpp>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>

using namespace mfem;
using namespace synovia;
using Catch::Matchers::Contains;

namespace
{
int CountOf(const std::string &part, const std::string &text)
{
   int count = 0;
   for (std::size_t at = text.find(part); at != std::string::npos;
        at = text.find(part, at + 1))
   {
      count++;
   }
   return count;
}

int Ranks()
{
   int size = 0;
   MPI_Comm_size(MPI_COMM_WORLD, &size);
   return size;
}

std::string FromBase64(const std::string &text)
{
   const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrst"
                              "uvwxyz0123456789+/";
   std::string bytes;
   unsigned bits = 0;
   int count = 0;
   for (const char c : text)
   {
      const std::size_t digit = digits.find(c);
      if (digit == std::string::npos) // padding
      {
         break;
      }
      bits = bits << 6 | static_cast<unsigned>(digit);
      count += 6;
      if (count >= 8)
      {
         count -= 8;
         bytes.push_back(static_cast<char>(bits >> count & 0xff));
      }
   }
   return bytes;
}

/// The numbers of the first array after the given text; not compressed.
std::vector<double> FirstArray(const std::string &text,
                               const std::string &after)
{
   // Four bytes with the size make eight digits, padded.
   const std::size_t data =
      text.find('\n', text.find("<DataArray", text.find(after))) + 1;
   const std::string bytes =
      FromBase64(text.substr(data + 8, text.find('\n', data + 8) - data - 8));
   std::vector<double> numbers(bytes.size() / sizeof(double));
   std::memcpy(numbers.data(), bytes.data(), numbers.size() * sizeof(double));
   return numbers;
}
} // namespace

TEST_CASE("Fields go to a series of files that name each other", "[io]")
{
   const TemporaryDirectory temp;
   BoxOptions box;
   box.type = Element::TETRAHEDRON;
   NamedMesh mesh = MakeBox(box);
   const H1_FECollection elements(2, 3);
   ParFiniteElementSpace tensors(&mesh.Get(), &elements, 6);
   ParGridFunction stress(&tensors);
   stress = 1.0;
   {
      ParaViewOutput output(temp / "fields", "volume", mesh.Get(), 2);
      output.Register("total_stress", stress);
      output.Save(0, 0.0);
      output.Save(1, 12.5);
      // Whole at any time, not only at the end.
      const std::string series = ReadText(temp / "fields/volume/volume.pvd");
      CHECK(CountOf("<DataSet", series) == 2);
      CHECK_THAT(series, Contains("timestep=\"12.5\"") &&
                            Contains("file=\"Cycle000001/data.pvtu\"") &&
                            Contains("</VTKFile>"));
   }
   const std::string pieces =
      ReadText(temp / "fields/volume/Cycle000001/data.pvtu");
   CHECK(CountOf("<Piece", pieces) == Ranks());
   CHECK_THAT(pieces, Contains("Name=\"total_stress\" "
                               "NumberOfComponents=\"6\""));
}

TEST_CASE("Each node is written once, with its value", "[io]")
{
   const auto type =
      GENERATE(Element::TETRAHEDRON, Element::HEXAHEDRON, Element::WEDGE);
   const int order = GENERATE(1, 2, 3);
   BoxOptions box;
   box.type = type;
   NamedMesh mesh = MakeBox(box);
   const H1_FECollection elements(order, 3);
   ParFiniteElementSpace vectors(&mesh.Get(), &elements, 3);
   ParGridFunction place(&vectors);
   VectorFunctionCoefficient itself(3,
                                    [](const Vector &x, Vector &y) { y = x; });
   place.ProjectCoefficient(itself);
   std::ostringstream file;
   VtuPiece(mesh.Get(), order, 0).Write(file, {{"place", &place}});

   const std::string text = file.str();
   CHECK_THAT(text, Contains("NumberOfPoints=\"" +
                             std::to_string(vectors.GetNDofs()) + "\""));
   // The field is the place, so that both arrays hold the same numbers, up to
   // the round-off in which nodes differ that are not equidistant.
   const std::vector<double> points = FirstArray(text, "<Points>");
   const std::vector<double> values = FirstArray(text, "<PointData>");
   REQUIRE(points.size() == std::size_t(vectors.GetVSize()));
   REQUIRE(values.size() == points.size());
   for (std::size_t i = 0; i < points.size(); i++)
   {
      REQUIRE(values[i] == Approx(points[i]).margin(1e-12));
   }
}

TEST_CASE("A surface that not all ranks have a part of is saved", "[io]")
{
   const TemporaryDirectory temp;
   BoxOptions box;
   box.nz = 12;
   NamedMesh mesh = MakeBox(box);
   ParSubMesh surface =
      ParSubMesh::CreateFromBoundary(mesh.Get(), mesh.Boundary("z1"));
   const H1_FECollection elements(1, 2);
   ParFiniteElementSpace scalars(&surface, &elements);
   ParGridFunction gap(&scalars);
   gap = 0.25;
   ParaViewOutput output(temp / "fields", "top", surface, 1);
   output.Register("gap", gap);
   CHECK_NOTHROW(output.Save(3, 1.0));
   CHECK_THAT(ReadText(temp / "fields/top/Cycle000003/data.pvtu"),
              Contains("Name=\"gap\""));
}

TEST_CASE("A restart keeps the steps before it", "[io]")
{
   const TemporaryDirectory temp;
   NamedMesh mesh = MakeBox({});
   {
      ParaViewOutput output(temp.Path(), "volume", mesh.Get(), 1);
      output.Save(0, 0.0);
      output.Save(1, 1.0);
      output.Save(2, 2.0);
   }
   MPI_Barrier(MPI_COMM_WORLD);
   {
      ParaViewOutput output(temp.Path(), "volume", mesh.Get(), 1, true);
      output.Save(2, 1.5);
   }
   const std::string series = ReadText(temp / "volume/volume.pvd");
   CHECK(CountOf("<DataSet", series) == 3);
   CHECK_THAT(series,
              Contains("timestep=\"1.5\"") && !Contains("timestep=\"2\""));
}

TEST_CASE("Fields that can't be written are an error on all ranks", "[io]")
{
   const TemporaryDirectory temp;
   temp.OnRootOnly([&]() { std::ofstream(temp / "file") << "a file"; });
   NamedMesh mesh = MakeBox({});
   REQUIRE_THROWS_WITH(ParaViewOutput(temp / "file", "volume", mesh.Get(), 1),
                       Contains("file/volume"));

   ParaViewOutput output(temp.Path(), "volume", mesh.Get(), 1);
   output.Save(0, 0.0);
   // A file in the place of the directory of the next cycle, and then pieces
   // on a disk without space.
   temp.OnRootOnly(
      [&]()
      {
         std::ofstream(temp / "volume/Cycle000001") << "a file";
         std::filesystem::create_directory(temp / "volume/Cycle000002");
         for (int rank = 0; rank < Ranks(); rank++)
         {
            std::filesystem::create_symlink(
               "/dev/full", temp / "volume/Cycle000002/proc00000" +
                               std::to_string(rank) + ".vtu");
         }
      });
   REQUIRE_THROWS_WITH(output.Save(1, 1.0), Contains("Cycle000001"));
   REQUIRE_THROWS_WITH(output.Save(2, 2.0),
                       Contains("proc000000.vtu': No space left on device"));
   CHECK_NOTHROW(output.Save(3, 3.0));
}
