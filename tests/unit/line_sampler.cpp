// ranks: 1 2 3

#include "synovia/io/line_sampler.hpp"
#include "support/boxes.hpp"
#include "support/temporary_directory.hpp"
#include "support/two_boxes.hpp"
#include "synovia/general/error.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <filesystem>
#include <fstream>

using namespace mfem;
using namespace synovia;
using Catch::Matchers::Contains;

namespace
{
/// A displacement and a pressure that order 2 has exactly.
void Displacement(const Vector &x, Vector &u)
{
   u(0) = x(0) * x(1) - x(2);
   u(1) = 1.0 + x(1) * x(1);
   u(2) = x(2) * x(0) + 0.5 * x(2) * x(2);
}

real_t Pressure(const Vector &x)
{
   return 2.0 + x(0) - 3.0 * x(1) * x(2);
}

/// Both as fields.
struct Fields
{
   explicit Fields(ParMesh &mesh)
      : elements(2, 3), vectors(&mesh, &elements, 3, Ordering::byVDIM),
        scalars(&mesh, &elements), u(&vectors), p(&scalars)
   {
      VectorFunctionCoefficient displacement(3, Displacement);
      FunctionCoefficient pressure(Pressure);
      u.ProjectCoefficient(displacement);
      p.ProjectCoefficient(pressure);
   }

   std::vector<SampledField> All() const
   {
      return {{{"p"}, &p}, {{"ux", "uy", "uz"}, &u}};
   }

   H1_FECollection elements;
   ParFiniteElementSpace vectors;
   ParFiniteElementSpace scalars;
   ParGridFunction u;
   ParGridFunction p;
};

/// The largest difference from the exact fields in any row.
real_t WorstError(const SampledTable &table)
{
   real_t worst = 0.0;
   for (int i = 0; i < table.values.Height(); i++)
   {
      Vector x(3);
      Vector u(3);
      for (int d = 0; d < 3; d++)
      {
         x(d) = table.values(i, 1 + d);
      }
      Displacement(x, u);
      worst = std::max(worst, std::abs(table.values(i, 4) - Pressure(x)));
      for (int d = 0; d < 3; d++)
      {
         worst = std::max(worst, std::abs(table.values(i, 5 + d) - u(d)));
      }
   }
   return worst;
}
} // namespace

TEST_CASE("Fields are sampled exactly, on edges and faces too", "[io]")
{
   BoxOptions box;
   box.nx = box.ny = 3;
   box.nz = 2;
   box.size_z = 0.75;
   box.type =
      GENERATE(Element::HEXAHEDRON, Element::TETRAHEDRON, Element::WEDGE);
   NamedMesh mesh = MakeBox(box);
   const Fields fields(mesh.Get());

   LineDefinition line;
   line.points = 37;
   line.from = {0.0, 0.0, 0.0};
   line.to = GENERATE(std::array<real_t, 3>{1.0, 0.0, 0.0},
                      std::array<real_t, 3>{0.0, 0.0, 0.75},
                      std::array<real_t, 3>{1.0, 1.0, 0.75},
                      std::array<real_t, 3>{0.9, 0.31, 0.55});
   const LineSampler sampler(mesh, line);
   const SampledTable table = sampler.Sample(fields.All());
   CHECK(table.columns ==
         std::vector<std::string>{"s", "x", "y", "z", "p", "ux", "uy", "uz"});
   REQUIRE(table.values.Height() == 37);
   CHECK(WorstError(table) < 1e-12);

   // The ends, and equal distances between.
   const real_t length = std::hypot(line.to[0], line.to[1], line.to[2]);
   for (int i = 0; i < 37; i++)
   {
      CHECK(table.values(i, 0) == Approx(i * length / 36).margin(1e-14));
   }
   CHECK(table.values(36, 3) == Approx(line.to[2]));
}

TEST_CASE("A line in an interface takes the values of its region", "[io]")
{
   NamedMesh mesh =
      MakeTwoBoxes(GENERATE(Element::HEXAHEDRON, Element::TETRAHEDRON));
   const H1_FECollection elements(1, 3);
   ParFiniteElementSpace space(&mesh.Get(), &elements);
   ParGridFunction body(&space);
   Vector attributes({1.0, 2.0});
   PWConstCoefficient coefficient(attributes);
   body.ProjectCoefficient(coefficient);

   LineDefinition line;
   line.from = {0.0, 0.0, 1.0};
   line.to = {1.0, 1.0, 1.0};
   for (const auto &[region, value] :
        {std::make_pair("lower", 1.0), std::make_pair("upper", 2.0)})
   {
      line.regions = {region};
      const SampledTable table =
         LineSampler(mesh, line).Sample({{{"body"}, &body}});
      Vector column;
      table.values.GetColumn(4, column);
      CHECK(column.Min() == Approx(value));
      CHECK(column.Max() == Approx(value));
   }

   // Through both bodies, each point is in one of them.
   line.from = {0.3, 0.4, 0.0};
   line.to = {0.3, 0.4, 2.0};
   line.points = 5;
   line.regions = {"lower", "upper"};
   const SampledTable table =
      LineSampler(mesh, line).Sample({{{"body"}, &body}});
   CHECK(table.values(1, 4) == Approx(1.0));
   CHECK(table.values(3, 4) == Approx(2.0));
}

TEST_CASE("Points are found in curved elements", "[io]")
{
   BoxOptions box;
   box.nx = box.ny = box.nz = 2;
   box.type = GENERATE(Element::HEXAHEDRON, Element::TETRAHEDRON);
   Mesh serial = MakeBoxMesh(box);
   serial.SetCurvature(2);
   serial.Transform(
      [](const Vector &x, Vector &y)
      {
         // A bent and tapered bar.
         y = x;
         y(0) *= 1.0 + 0.3 * x(2) * x(2);
         y(1) += 0.2 * x(0) * x(0);
      });
   NamedMesh mesh = DistributeMesh(serial, {{"body", {1}}}, {}, MPI_COMM_WORLD);

   // The field of coordinates at a point is that point.
   LineDefinition line;
   line.from = {0.02, 0.05, 0.01};
   line.to = {1.1, 0.8, 0.9};
   line.points = 29;
   const auto &nodes = dynamic_cast<ParGridFunction &>(*mesh.Get().GetNodes());
   const SampledTable table =
      LineSampler(mesh, line).Sample({{{"X", "Y", "Z"}, &nodes}});
   for (int i = 0; i < table.values.Height(); i++)
   {
      for (int d = 0; d < 3; d++)
      {
         CHECK(table.values(i, 4 + d) ==
               Approx(table.values(i, 1 + d)).margin(1e-12));
      }
   }
}

TEST_CASE("Fields continue a little way outside, and no further", "[io]")
{
   BoxOptions box;
   box.nx = box.ny = box.nz = 2;
   box.type = GENERATE(Element::HEXAHEDRON, Element::TETRAHEDRON);
   NamedMesh mesh = MakeBox(box);
   const Fields fields(mesh.Get());

   LineDefinition line;
   line.name = "rim";
   // Elements are 0.5 long.
   line.from = {0.0, 0.3, 1.01};
   line.to = {1.01, 0.3, 1.01};
   const SampledTable table = LineSampler(mesh, line).Sample(fields.All());
   CHECK(WorstError(table) < 1e-11);

   line.to = {1.1, 0.3, 1.01};
   REQUIRE_THROWS_WITH(LineSampler(mesh, line),
                       Contains("line 'rim': ") &&
                          Contains("of 51 points are not in the region") &&
                          Contains(", 0.3, 1.01)"));
}

TEST_CASE("A line that makes no sense is refused", "[io]")
{
   NamedMesh mesh = MakeBox({});
   const Fields fields(mesh.Get());
   LineDefinition line;
   line.name = "axis";
   line.to = {0.0, 0.0, 1.0};
   {
      LineDefinition wrong = line;
      wrong.regions = {"bone"};
      REQUIRE_THROWS_WITH(LineSampler(mesh, wrong),
                          Contains("line 'axis'") && Contains("bone"));
      wrong = line;
      wrong.points = 1;
      REQUIRE_THROWS_WITH(LineSampler(mesh, wrong), Contains("at least 2"));
      wrong = line;
      wrong.to = wrong.from;
      REQUIRE_THROWS_WITH(LineSampler(mesh, wrong),
                          Contains("two different ends"));
   }
   const LineSampler sampler(mesh, line);
   REQUIRE_THROWS_WITH(sampler.Sample({{{"ux", "uy"}, &fields.u}}),
                       Contains("a field of 3 components is given 2 columns"));
}

TEST_CASE("A sampled line is written as a table", "[io]")
{
   const TemporaryDirectory temp;
   NamedMesh mesh = MakeBox({});
   const Fields fields(mesh.Get());
   LineDefinition line;
   line.name = "axis";
   line.to = {0.0, 0.0, 1.0};
   line.points = 3;
   const LineSampler sampler(mesh, line);
   sampler.Write(temp / "lines", 0.25, fields.All());
   sampler.Write(temp / "lines", 500.0, fields.All());
   CHECK(ReadText(temp / "lines/axis_t0.25.csv") == "s,x,y,z,p,ux,uy,uz\n"
                                                    "0,0,0,0,2,0,1,0\n"
                                                    "0.5,0,0,0.5,2,-0.5,1,"
                                                    "0.125\n"
                                                    "1,0,0,1,2,-1,1,0.5\n");
   CHECK(std::filesystem::exists(temp / "lines/axis_t500.csv"));

   temp.OnRootOnly([&]() { std::ofstream(temp / "file") << "a file"; });
   REQUIRE_THROWS_WITH(sampler.Write(temp / "file", 1.0, fields.All()),
                       Contains("file'"));
}
