// ranks: 1
//
// Faces as polynomials: the same as their shape functions, on the face and
// around it.

#include "synovia/contact/face_polynomial.hpp"

#include <catch2/catch.hpp>

#include <cmath>

using namespace mfem;
using namespace synovia;

namespace
{
// Nodes of a face of a few millimeters that is far from the origin.
DenseMatrix SomeNodes(int count)
{
   DenseMatrix nodes(3, count);
   for (int k = 0; k < count; k++)
   {
      for (int d = 0; d < 3; d++)
      {
         nodes(d, k) = 40.0 + std::sin(1.0 + 3.7 * k + 1.9 * d * (k + 1));
      }
   }
   return nodes;
}

real_t Distance(const Point3 &a, const Vector &b)
{
   real_t sum = 0.0;
   for (int d = 0; d < 3; d++)
   {
      sum += (a[d] - b[d]) * (a[d] - b[d]);
   }
   return std::sqrt(sum);
}

Point3 Difference(const Point3 &a, const Point3 &b, real_t step)
{
   Point3 result = Sum(a, -1.0, b);
   for (real_t &component : result)
   {
      component /= step;
   }
   return result;
}
} // namespace

TEST_CASE("A face's polynomial is the sum of its shape functions")
{
   for (const Geometry::Type geometry : {Geometry::TRIANGLE, Geometry::SQUARE})
   {
      for (int order = 1; order <= 4; order++)
      {
         const H1_FECollection collection(order, 2);
         const FiniteElement &element =
            *collection.FiniteElementForGeometry(geometry);
         const DenseMatrix nodes = SomeNodes(element.GetDof());
         FacePolynomial polynomial(element);
         Mult(nodes, FacePolynomial::PowersFromNodes(element),
              polynomial.Coefficients());

         Vector shape(element.GetDof());
         DenseMatrix dshape(element.GetDof(), 2);
         Vector expected(3);
         DenseMatrix tangents(3, 2);
         // Partners are projected from outside the face as well.
         for (const real_t xi : {-0.4, 0.0, 0.3, 1.0})
         {
            for (const real_t eta : {0.0, 0.2, 0.7, 1.3})
            {
               IntegrationPoint ip;
               ip.Set2(xi, eta);
               element.CalcShape(ip, shape);
               element.CalcDShape(ip, dshape);
               nodes.Mult(shape, expected);
               Mult(nodes, dshape, tangents);
               const SurfacePoint at = polynomial(xi, eta);
               CAPTURE(geometry, order, xi, eta);
               // Far outside, large terms cancel.
               constexpr real_t round_off = 1e-13;
               const real_t large = 40.0 * (1.0 + shape.Norml1());
               CHECK(Distance(at.position, expected) < round_off * large);
               for (int a = 0; a < 2; a++)
               {
                  tangents.GetColumn(a, expected);
                  CHECK(Distance(at.tangents[a], expected) <
                        10.0 * round_off * large);
               }
            }
         }
      }
   }
}

TEST_CASE("A face's second derivatives are differences of its tangents")
{
   for (const Geometry::Type geometry : {Geometry::TRIANGLE, Geometry::SQUARE})
   {
      const H1_FECollection collection(3, 2);
      const FiniteElement &element =
         *collection.FiniteElementForGeometry(geometry);
      FacePolynomial polynomial(element);
      Mult(SomeNodes(element.GetDof()),
           FacePolynomial::PowersFromNodes(element), polynomial.Coefficients());
      constexpr real_t step = 1e-4;
      const BentSurfacePoint bent = polynomial.Bent(0.3, 0.2);
      const std::array<Point3, 3> &second = bent.second;
      const SurfacePoint at = polynomial(0.3, 0.2);
      CHECK(Length(Sum(at.position, -1.0, bent.point.position)) == 0.0);
      for (int a = 0; a < 2; a++)
      {
         CHECK(Length(Sum(at.tangents[a], -1.0, bent.point.tangents[a])) ==
               0.0);
      }
      const SurfacePoint right = polynomial(0.3 + step, 0.2);
      const SurfacePoint left = polynomial(0.3 - step, 0.2);
      const SurfacePoint up = polynomial(0.3, 0.2 + step);
      const SurfacePoint down = polynomial(0.3, 0.2 - step);
      const auto off = [&](const Point3 &curvature, const Point3 &forward,
                           const Point3 &backward)
      {
         return Length(
            Sum(curvature, -1.0, Difference(forward, backward, 2.0 * step)));
      };
      CHECK(Length(second[0]) > 1.0);
      CHECK(off(second[0], right.tangents[0], left.tangents[0]) < 1e-4);
      CHECK(off(second[1], up.tangents[0], down.tangents[0]) < 1e-4);
      CHECK(off(second[1], right.tangents[1], left.tangents[1]) < 1e-4);
      CHECK(off(second[2], up.tangents[1], down.tangents[1]) < 1e-4);
   }
}

TEST_CASE("Normals of level faces have no round-off")
{
   const H1_FECollection collection(2, 2);
   const FiniteElement &element =
      *collection.FiniteElementForGeometry(Geometry::SQUARE);
   DenseMatrix nodes(3, element.GetDof());
   for (int k = 0; k < nodes.Width(); k++)
   {
      const IntegrationPoint &ip = element.GetNodes().IntPoint(k);
      nodes(0, k) = 2.7 + 0.013 * ip.x + 0.002 * ip.x * ip.y;
      nodes(1, k) = 0.1 + 0.011 * ip.y;
      nodes(2, k) = 0.75;
   }
   FacePolynomial polynomial(element);
   Mult(nodes, FacePolynomial::PowersFromNodes(element),
        polynomial.Coefficients());
   for (const real_t xi : {0.1, 0.4, 0.9})
   {
      const Point3 normal = polynomial(xi, 0.3).UnitNormal();
      CHECK(normal[0] == 0.0);
      CHECK(normal[1] == 0.0);
      CHECK(std::abs(normal[2] - 1.0) < 1e-15);
   }
}
