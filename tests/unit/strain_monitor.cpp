// ranks: 1 2 3
//
// The largest principal strain and the smallest det F against closed forms, and
// the places where they are, which must not depend on the ranks.

#include "synovia/fem/strain_monitor.hpp"
#include "support/boxes.hpp"
#include "support/round_meshes.hpp"
#include "support/two_boxes.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <functional>

using namespace mfem;
using namespace synovia;

namespace
{
using VectorFunction = std::function<void(const Vector &, Vector &)>;

/// A mesh with a displacement on it.
struct Deformed
{
   Deformed(NamedMesh mesh_, int order)
      : mesh(std::move(mesh_)), elements(order, 3),
        space(&mesh.Get(), &elements, 3, Ordering::byVDIM), u(&space)
   {
      u = 0.0;
   }

   StrainExtremes Measure(const VectorFunction &displacement,
                          Deformation deformation = Deformation::infinitesimal)
   {
      VectorFunctionCoefficient coefficient(3, displacement);
      u.ProjectCoefficient(coefficient);
      return StrainMonitor(mesh, u, deformation).Measure();
   }

   NamedMesh mesh;
   H1_FECollection elements;
   ParFiniteElementSpace space;
   ParGridFunction u;
};

BoxOptions Cells(Element::Type type)
{
   BoxOptions box;
   box.nx = box.ny = 2;
   box.nz = 3;
   box.type = type;
   return box;
}

void CheckPlace(const StrainExtreme &extreme, real_t x, real_t y, real_t z)
{
   CHECK(extreme.place[0] == Approx(x).margin(1e-12));
   CHECK(extreme.place[1] == Approx(y).margin(1e-12));
   CHECK(extreme.place[2] == Approx(z).margin(1e-12));
}

/// u = A x
VectorFunction Affine(const DenseMatrix &a)
{
   return [a](const Vector &x, Vector &u) { a.Mult(x, u); };
}
} // namespace

TEST_CASE("An affine displacement has the same strains everywhere", "[strain]")
{
   const auto type =
      GENERATE(Element::HEXAHEDRON, Element::TETRAHEDRON, Element::WEDGE);
   const int order = GENERATE(1, 2, 3);
   Deformed body(MakeBox(Cells(type)), order);
   // Principal strains 0.1 and -0.2 in the plane x, y, turned by 30 degrees,
   // and 0.05 along z; a rotation about z leaves the strains and not det F.
   const real_t c = std::sqrt(0.75);
   const real_t s = 0.5;
   const real_t w = 0.3;
   DenseMatrix a(3);
   a = 0.0;
   a(0, 0) = 0.1 * c * c - 0.2 * s * s;
   a(1, 1) = 0.1 * s * s - 0.2 * c * c;
   a(0, 1) = 0.3 * c * s - w;
   a(1, 0) = 0.3 * c * s + w;
   a(2, 2) = 0.05;
   const StrainExtremes found = body.Measure(Affine(a));
   CHECK(found.max_principal.value == Approx(-0.2).epsilon(1e-12));
   CHECK(found.min_det_F.value ==
         Approx((1.1 * 0.8 + w * w) * 1.05).epsilon(1e-12));
   CHECK(found.max_principal.region == "body");

   a *= -1.0;
   CHECK(body.Measure(Affine(a)).max_principal.value ==
         Approx(0.2).epsilon(1e-12));
}

TEST_CASE("In finite deformation strains are logarithms of stretches, which a "
          "rotation leaves",
          "[strain]")
{
   Deformed body(
      MakeBox(Cells(GENERATE(Element::HEXAHEDRON, Element::TETRAHEDRON))),
      GENERATE(1, 2));
   // Stretches 1.3, 0.6 and 0.9, or small ones, then by 90 degrees about z:
   // F = (-y stretched, x stretched, z stretched).
   const real_t part = GENERATE(1.0, 1e-6);
   DenseMatrix a(3);
   a = 0.0;
   a(0, 1) = -(1.0 - 0.4 * part);
   a(1, 0) = 1.0 + 0.3 * part;
   a(2, 2) = -0.1 * part;
   a(0, 0) = a(1, 1) = -1.0;
   const StrainExtremes found = body.Measure(Affine(a), Deformation::finite);
   CHECK(found.max_principal.value ==
         Approx(std::log1p(-0.4 * part)).margin(1e-15));
   CHECK(found.min_det_F.value ==
         Approx((1.0 - 0.4 * part) * (1.0 + 0.3 * part) * (1.0 - 0.1 * part))
            .epsilon(1e-12));
   CHECK(found.max_principal.region == "body");
}

TEST_CASE("In finite deformation the largest strain is found where it is",
          "[strain]")
{
   // A column that is compressed more towards its top.
   Deformed body(MakeBox(Cells(Element::TETRAHEDRON)), 2);
   const StrainExtremes found = body.Measure(
      [](const Vector &x, Vector &u)
      {
         u = 0.0;
         u[2] = -0.3 * x[2] * x[2];
      },
      Deformation::finite);
   CHECK(found.max_principal.value == Approx(std::log(0.4)).epsilon(1e-12));
   CHECK(found.max_principal.place[2] == Approx(1.0));
   CHECK(found.min_det_F.value == Approx(0.4).epsilon(1e-12));
}

TEST_CASE("Tension stands for equal strains of both signs", "[strain]")
{
   Deformed body(MakeBox(Cells(Element::HEXAHEDRON)), 1);
   DenseMatrix shear(3);
   shear = 0.0;
   shear(0, 1) = -0.4;
   const StrainExtremes found = body.Measure(Affine(shear));
   CHECK(found.max_principal.value == Approx(0.2).epsilon(1e-12));
   CHECK(found.min_det_F.value == Approx(1.0).epsilon(1e-12));
   shear = 0.0;
   const StrainExtremes rest = body.Measure(Affine(shear));
   CHECK(rest.max_principal.value == 0.0);
   CHECK(rest.min_det_F.value == 1.0);
   CHECK(rest.max_principal.region == "body");
}

TEST_CASE("A quadratic displacement has its extremes where they are known",
          "[strain]")
{
   const auto type =
      GENERATE(Element::HEXAHEDRON, Element::TETRAHEDRON, Element::WEDGE);
   Deformed body(MakeBox(Cells(type)), 2);
   // eps_zz = -(0.1 + 0.2 z) (1 + x) grows towards z = x = 1, shears are small.
   const StrainExtremes found = body.Measure(
      [](const Vector &x, Vector &u)
      {
         u = 0.0;
         u(2) = -0.1 * x(2) - 0.1 * x(2) * x(2) - 0.05 * x(2) * x(0);
      });
   // At (1, y, 1): eps_zz = -0.35, eps_xz = -0.025.
   const real_t shear = 0.025;
   const real_t least = -0.175 - std::sqrt(0.175 * 0.175 + shear * shear);
   CHECK(found.max_principal.value == Approx(least).epsilon(1e-12));
   CHECK(found.min_det_F.value == Approx(0.65).epsilon(1e-12));
   CHECK(found.max_principal.place[0] == Approx(1.0));
   CHECK(found.max_principal.place[2] == Approx(1.0));
   CHECK(found.min_det_F.place[0] == Approx(1.0));
   CHECK(found.min_det_F.place[2] == Approx(1.0));
}

TEST_CASE("Order 2 on hexahedra is looked at between the corners", "[strain]")
{
   BoxOptions box;
   box.nx = box.ny = 1;
   box.nz = 3;
   Deformed body(MakeBox(box), 2);
   // eps_zz = -0.2 in the middle of the box's sides, and 0 at its edges.
   const StrainExtremes found = body.Measure(
      [](const Vector &x, Vector &u)
      {
         u = 0.0;
         u(2) = -0.8 * x(2) * x(0) * (1.0 - x(0));
      });
   CHECK(found.min_det_F.value == Approx(0.8).epsilon(1e-12));
   CHECK(found.min_det_F.place[0] == Approx(0.5));
}

TEST_CASE("Curved elements know their own geometry", "[strain]")
{
   RoundOptions round;
   round.order = 2;
   Deformed body(MakeBallOctant(round), GENERATE(2, 3));
   DenseMatrix a(3);
   a = 0.0;
   a(2, 2) = -0.25;
   const StrainExtremes found = body.Measure(Affine(a));
   CHECK(found.max_principal.value == Approx(-0.25).epsilon(1e-12));
   CHECK(found.min_det_F.value == Approx(0.75).epsilon(1e-12));
}

TEST_CASE("An element turned inside out is found with region and place",
          "[strain]")
{
   Deformed bodies(MakeTwoBoxes(Element::HEXAHEDRON), 1);
   // The corner (1, 1, 2) of the upper box goes down through its element, whose
   // edges are 1/3 long, and no other node moves.
   const StrainExtremes found = bodies.Measure(
      [](const Vector &x, Vector &u)
      {
         u = 0.0;
         const bool moves = x(0) > 0.99 && x(1) > 0.99 && x(2) > 1.99;
         u(2) = moves ? -0.5 : 0.0;
      });
   CHECK(found.min_det_F.value == Approx(1.0 - 0.5 * 3.0).epsilon(1e-12));
   CHECK(found.min_det_F.region == "upper");
   // Along the vertical edge det F is the same: its first node counts.
   CheckPlace(found.min_det_F, 1.0, 1.0, 5.0 / 3.0);
   // At the corner grad u has the row (-1.5, -1.5, -1.5) for u_z alone.
   CHECK(found.max_principal.value ==
         Approx(-0.75 * (1.0 + std::sqrt(3.0))).epsilon(1e-12));
   CHECK(found.max_principal.region == "upper");
   CheckPlace(found.max_principal, 1.0, 1.0, 2.0);
}

TEST_CASE("Of equal extremes the first in the mesh is given on all ranks",
          "[strain]")
{
   // All elements of both boxes are strained alike, but for what rounding does.
   Deformed bodies(MakeTwoBoxes(Element::HEXAHEDRON), 1);
   const StrainExtremes found = bodies.Measure(
      [](const Vector &x, Vector &u)
      {
         u = 0.0;
         u(2) = -0.1 * x(2) * (1.0 + 1e-9 * std::sin(17.0 * x(2)));
      });
   CHECK(found.max_principal.value == Approx(-0.1).epsilon(1e-8));
   CHECK(found.max_principal.region == "lower");
   CheckPlace(found.max_principal, 0.0, 0.0, 0.0);
   CHECK(found.min_det_F.region == "lower");
   CheckPlace(found.min_det_F, 0.0, 0.0, 0.0);
}
