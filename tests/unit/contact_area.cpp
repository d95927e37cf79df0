// ranks: 1 2 3
//
// The area where a function of the vertices is negative, of what the source
// covers: exact for linear functions, whose zero line is straight.

#include "synovia/contact/contact_area.hpp"
#include "support/boxes.hpp"
#include "synovia/contact/gap_operators.hpp"
#include "synovia/general/reduce.hpp"

#include <catch2/catch.hpp>

#include <cmath>

using namespace mfem;
using namespace synovia;

namespace
{
constexpr real_t round_off = 1e-12;

/// The top of a box of 1 x 1 under another one.
class Surface
{
public:
   /// @param width    of the upper box, from the corner at the origin
   Surface(Element::Type type, int cells, real_t width = 1.0)
      : mesh(MakeBodies(type, cells, width)), spaces(mesh.Get(), 1),
        upper(spaces, mesh.Boundary("upper_z0")),
        lower(spaces, mesh.Boundary("lower_z1"))
   {
      GapOptions options;
      options.search_radius = 0.5;
      operators = AssembleGapOperators(upper, lower, options);
   }

   /// At the vertices, of a function of x and y.
   Vector Values(const std::function<real_t(real_t, real_t)> &function)
   {
      FunctionCoefficient coefficient([&](const Vector &x)
                                      { return function(x[0], x[1]); });
      ParGridFunction values(&spaces.Multiplier());
      values.ProjectCoefficient(coefficient);
      Vector true_dofs;
      values.GetTrueDofs(true_dofs);
      return lower.Vertices().FromTrueDofs(true_dofs);
   }

   /// Of all ranks.
   real_t AreaOf(const std::function<real_t(real_t, real_t)> &function)
   {
      return NegativeArea(lower, operators.face_coverage, Values(function));
   }

   Vector MeansOf(const Vector &values) const
   {
      return VertexMeans(lower, operators.face_coverage, values);
   }

   const Vector &VertexAreas() const { return operators.area; }

   int Faces() const
   {
      return static_cast<int>(std::lround(SumOverRanks(
         static_cast<real_t>(operators.face_coverage.size()), MPI_COMM_WORLD)));
   }

private:
   static NamedMesh MakeBodies(Element::Type type, int cells, real_t width)
   {
      BoxOptions lower;
      lower.nx = lower.ny = cells;
      lower.nz = 1;
      lower.type = type;
      BoxOptions upper(lower);
      upper.nx = cells + 1;
      upper.size_x = width;
      return MakeStack(lower, upper);
   }

   NamedMesh mesh;
   BiphasicSpaces spaces;
   ContactSurface upper;
   ContactSurface lower;
   GapOperators operators;
};

Element::Type AnyType()
{
   return GENERATE(Element::HEXAHEDRON, Element::TETRAHEDRON);
}
} // namespace

TEST_CASE("Where a linear function is negative")
{
   const Element::Type type = AnyType();
   CAPTURE(static_cast<int>(type));
   constexpr int cells = 4;
   Surface surface(type, cells);
   CHECK(surface.Faces() ==
         cells * cells * (type == Element::HEXAHEDRON ? 1 : 2));
   CHECK(surface.AreaOf([](real_t, real_t) { return -1.0; }) ==
         Approx(1.0).epsilon(round_off));
   CHECK(surface.AreaOf([](real_t, real_t) { return 1.0; }) == 0.0);
   CHECK(surface.AreaOf([](real_t, real_t) { return 0.0; }) == 0.0);
   for (const real_t at : {0.01, 0.25, 0.3, 0.49, 0.5, 0.93})
   {
      CAPTURE(at);
      CHECK(surface.AreaOf([&](real_t x, real_t) { return x - at; }) ==
            Approx(at).epsilon(round_off));
      CHECK(surface.AreaOf([&](real_t, real_t y) { return at - y; }) ==
            Approx(1.0 - at).epsilon(round_off));
      CHECK(surface.AreaOf([&](real_t x, real_t y) { return x + y - at; }) ==
            Approx(0.5 * at * at).epsilon(round_off));
   }
}

TEST_CASE("Means around the vertices")
{
   const Element::Type type = AnyType();
   CAPTURE(static_cast<int>(type));
   constexpr int cells = 3;
   Surface surface(type, cells);
   const Vector values =
      surface.Values([](real_t x, real_t y) { return 2.0 + x - 3.0 * y; });
   const Vector means = surface.MeansOf(values);
   const Vector &areas = surface.VertexAreas();
   // With the vertices' areas they add up to the integral.
   CHECK(InnerProduct(MPI_COMM_WORLD, means, areas) ==
         Approx(1.0).epsilon(round_off));
   // Around a vertex within, a linear function's mean is its value.
   real_t within = 0.0;
   for (int j = 0; j < means.Size(); j++)
   {
      if (areas[j] > 0.9 / (cells * cells))
      {
         within += 1.0;
         CHECK(means[j] == Approx(values[j]).epsilon(round_off));
      }
   }
   CHECK(SumOverRanks(within, MPI_COMM_WORLD) == 4.0);
}

TEST_CASE("Of a disc, with errors of second order")
{
   const Element::Type type = AnyType();
   CAPTURE(static_cast<int>(type));
   constexpr real_t radius = 0.83;
   const real_t exact = std::atan(1.0) * radius * radius;
   const auto error = [&](int cells)
   {
      Surface surface(type, cells);
      return std::abs(surface.AreaOf([](real_t x, real_t y)
                                     { return std::hypot(x, y) - radius; }) -
                      exact);
   };
   const real_t coarse = error(4);
   CHECK(coarse < 0.02 * exact);
   CHECK(error(16) < 0.1 * coarse);
}

TEST_CASE("Only what the source covers counts")
{
   const Element::Type type = AnyType();
   CAPTURE(static_cast<int>(type));
   // Ends within a row of faces.
   constexpr real_t width = 0.6;
   Surface surface(type, 4, width);
   CHECK(surface.AreaOf([](real_t, real_t) { return -1.0; }) ==
         Approx(width).epsilon(round_off));
   CHECK(surface.AreaOf([](real_t x, real_t) { return x - 0.3; }) ==
         Approx(0.3).epsilon(round_off));
   // Vertices without a say, at the rim of the source, change no sign.
   CHECK(
      surface.AreaOf([](real_t x, real_t) { return x > 0.7 ? 0.0 : -1.0; }) ==
      Approx(width).epsilon(round_off));
}

TEST_CASE("The zero line moves without jumps")
{
   const Element::Type type = AnyType();
   CAPTURE(static_cast<int>(type));
   Surface surface(type, 3);
   constexpr int steps = 200;
   real_t last = 0.0;
   for (int i = 1; i <= steps; i++)
   {
      const real_t radius = 1.2 * i / steps;
      const real_t now = surface.AreaOf(
         [&](real_t x, real_t y) { return x * x + y * y - radius * radius; });
      CAPTURE(radius, last, now);
      CHECK(now >= last);
      CHECK(now - last < 4.0 * radius * 1.2 / steps + 1e-3);
      last = now;
   }
   CHECK(last > 0.9);
}
