// Layers made in memory have the shape and the sides that they should.
//
// ranks: 1 2 3 4 16

#include "synovia/mesh/curved_layers.hpp"
#include "synovia/general/error.hpp"
#include "synovia/general/reduce.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <memory>

using namespace mfem;
using namespace synovia;

namespace
{
/// Volume of each region.
std::vector<real_t> Volumes(ParMesh &mesh)
{
   std::vector<real_t> volumes(2, 0.0);
   for (int i = 0; i < mesh.GetNE(); i++)
   {
      volumes[mesh.GetAttribute(i) - 1] += mesh.GetElementVolume(i);
   }
   for (real_t &volume : volumes)
   {
      volume = SumOverRanks(volume, mesh.GetComm());
   }
   return volumes;
}

/// Area of a boundary, and the largest distance of its quadrature points from a
/// surface z(x, y), to which @a distance is the distance.
struct Side
{
   real_t area = 0.0;
   real_t off = 0.0;
};

template <typename Distance>
Side Measure(NamedMesh &layers, const std::string &name, Distance distance)
{
   ParMesh &mesh = layers.Get();
   const Array<int> attributes = layers.Boundary(name);
   Side side;
   for (int i = 0; i < mesh.GetNBE(); i++)
   {
      if (attributes.Find(mesh.GetBdrAttribute(i)) < 0)
      {
         continue;
      }
      ElementTransformation &map = *mesh.GetBdrElementTransformation(i);
      const IntegrationRule &rule = IntRules.Get(map.GetGeometryType(), 8);
      for (int q = 0; q < rule.GetNPoints(); q++)
      {
         map.SetIntPoint(&rule[q]);
         Vector x;
         map.Transform(rule[q], x);
         side.area += rule[q].weight * map.Weight();
         side.off = std::max(side.off, std::abs(distance(x)));
      }
   }
   side.area = SumOverRanks(side.area, mesh.GetComm());
   side.off = MaxOverRanks(side.off, mesh.GetComm());
   return side;
}
} // namespace

TEST_CASE("curved layers")
{
   LayersOptions options;
   options.type = GENERATE(Element::HEXAHEDRON, Element::TETRAHEDRON);
   options.refine = GENERATE(0, 1);
   options.lower_cells = 4;
   options.upper_cells = 3;
   NamedMesh layers = MakeCurvedLayers(options, MPI_COMM_WORLD);
   CAPTURE(options.type, options.refine);

   SECTION("cells")
   {
      const int a_cell = (options.type == Element::HEXAHEDRON ? 1 : 6) *
                         (options.refine == 1 ? 8 : 1);
      CHECK(layers.Get().GetGlobalNE() == (4 * 4 * 2 + 3 * 3 * 2) * a_cell);
   }
   SECTION("volumes")
   {
      // The upper layer is sheared, which keeps its volume.
      for (const real_t volume : Volumes(layers.Get()))
      {
         CHECK(volume == Approx(4.0).epsilon(1e-10));
      }
   }
   SECTION("nodes that ranks share")
   {
      // Continuous functions are single-valued, and have as many unknowns as
      // there are nodes: ranks agree on the vertices, edges and faces that they
      // share.
      ParMesh &mesh = layers.Get();
      H1_FECollection shapes(2, 3);
      ParFiniteElementSpace space(&mesh, &shapes);
      const int split = options.refine == 1 ? 4 : 2;
      const auto nodes = [split](int across, int through) {
         return (split * across + 1) * (split * across + 1) *
                (split * through + 1);
      };
      CHECK(space.GlobalTrueVSize() == nodes(4, 2) + nodes(3, 2));
      ParGridFunction values(&space);
      FunctionCoefficient field([](const Vector &x)
                                { return x[0] + 3.0 * x[1] - 7.0 * x[2]; });
      values.ProjectCoefficient(field);
      ParGridFunction shared(values);
      const std::unique_ptr<HypreParVector> owned(values.GetTrueDofs());
      shared.Distribute(*owned);
      shared -= values;
      CHECK(shared.Normlinf() <= 1e-12);
      CHECK(values.Size() > 0);
   }
   SECTION("elements are numbered through")
   {
      const std::vector<int> numbers = layers.SerialElements();
      const auto count = static_cast<real_t>(layers.Get().GetGlobalNE());
      CHECK(static_cast<int>(numbers.size()) == layers.Get().GetNE());
      CHECK(std::is_sorted(numbers.begin(), numbers.end()));
      real_t sum = 0.0;
      real_t squares = 0.0;
      for (const int number : numbers)
      {
         sum += number;
         squares += 1.0 * number * number;
      }
      CHECK(SumOverRanks(sum, MPI_COMM_WORLD) == count * (count - 1.0) / 2.0);
      CHECK(SumOverRanks(squares, MPI_COMM_WORLD) ==
            (count - 1.0) * count * (2.0 * count - 1.0) / 6.0);
   }
   SECTION("surfaces")
   {
      const auto paraboloid = [](const Vector &x)
      { return (x[0] * x[0] + x[1] * x[1]) / 20.0; };
      const Side bone = Measure(layers, "lower_bone",
                                [](const Vector &x) { return x[2] + 1.0; });
      CHECK(bone.area == Approx(4.0).epsilon(1e-10));
      CHECK(bone.off <= 1e-12);
      const Side below =
         Measure(layers, "lower_contact", [](const Vector &x) { return x[2]; });
      CHECK(below.area == Approx(4.0).epsilon(1e-10));
      CHECK(below.off <= 1e-12);
      const Side above =
         Measure(layers, "upper_contact",
                 [&](const Vector &x) { return x[2] - paraboloid(x); });
      CHECK(above.area > 4.01);
      CHECK(above.off <= 1e-12);
      const Side top =
         Measure(layers, "upper_bone",
                 [&](const Vector &x) { return x[2] - 1.0 - paraboloid(x); });
      CHECK(top.area == Approx(above.area).epsilon(1e-10));
      CHECK(top.off <= 1e-12);
      // Both layers together.
      const Side x0 =
         Measure(layers, "symmetry_x", [](const Vector &x) { return x[0]; });
      CHECK(x0.area == Approx(4.0).epsilon(1e-10));
      CHECK(x0.off <= 1e-12);
      const Side y0 =
         Measure(layers, "symmetry_y", [](const Vector &x) { return x[1]; });
      CHECK(y0.area == Approx(4.0).epsilon(1e-10));
      CHECK(y0.off <= 1e-12);
      const Side rims =
         Measure(layers, "rims",
                 [](const Vector &x) { return std::max(x[0], x[1]) - 2.0; });
      CHECK(rims.area == Approx(8.0).epsilon(1e-10));
      CHECK(rims.off <= 1e-12);
   }
}

TEST_CASE("curved layers: more ranks than elements")
{
   int ranks = 1;
   MPI_Comm_size(MPI_COMM_WORLD, &ranks);
   LayersOptions options;
   options.lower_cells = 1;
   options.upper_cells = 1;
   if (ranks > 2)
   {
      CHECK_THROWS_AS(MakeCurvedLayers(options, MPI_COMM_WORLD), Error);
   }
   else
   {
      NamedMesh layers = MakeCurvedLayers(options, MPI_COMM_WORLD);
      CHECK(layers.Get().GetNE() == 2 / ranks);
   }
}

TEST_CASE("curved layers: options out of range")
{
   LayersOptions options;
   SECTION("no cells")
   {
      options.upper_cells = 0;
   }
   SECTION("negative refinement")
   {
      options.refine = -1;
   }
   SECTION("flat")
   {
      options.thickness = 0.0;
   }
   SECTION("prisms")
   {
      options.type = Element::WEDGE;
   }
   CHECK_THROWS_AS(MakeCurvedLayers(options, MPI_COMM_WORLD), Error);
}
