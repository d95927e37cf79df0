#pragma once

#include "synovia/general/point3.hpp"

namespace synovia
{

/// A point of a parameterized surface.
struct SurfacePoint
{
   Point3 position;
   /// Derivatives by xi and by eta.
   std::array<Point3, 2> tangents;

   Point3 AreaVector() const { return Cross(tangents[0], tangents[1]); }
   /// Area per area of the reference element.
   mfem::real_t AreaFactor() const { return Length(AreaVector()); }
   /// Exactly along an axis if it is but for round-off, which would couple all
   /// components of contact and make factors a fifth larger.
   Point3 UnitNormal() const
   {
      constexpr mfem::real_t round_off = 1e-11;
      Point3 normal = AreaVector();
      const mfem::real_t length = Length(normal);
      for (mfem::real_t &component : normal)
      {
         component /= length;
         if (std::abs(component) < round_off)
         {
            component = 0.0;
         }
      }
      return normal;
   }
};

/// A point of a parameterized surface, with its second derivatives.
struct BentSurfacePoint
{
   SurfacePoint point;
   /// Second derivatives: by xi twice, by both, by eta twice.
   std::array<Point3, 3> second;
};

/// A function on a reference triangle or square, with values in space, as
/// powers of the distance from the reference element's center: it and its
/// derivatives are evaluated faster than shape functions are.
class FacePolynomial
{
public:
   FacePolynomial() = default;
   /// @param element  whose space of polynomials it is, complete or of a tensor
   ///                 product
   explicit FacePolynomial(const mfem::FiniteElement &element);
   /// The zero function of that space on a triangle or a square.
   FacePolynomial(mfem::Geometry::Type geometry, int order);

   /// The map from values at the element's nodes, 3 x nodes, to coefficients,
   /// 3 x powers: nodes x powers.
   static mfem::DenseMatrix PowersFromNodes(const mfem::FiniteElement &element);

   int Order() const { return order; }
   /// 3 x powers.
   mfem::DenseMatrix &Coefficients() { return coefficients; }
   const mfem::DenseMatrix &Coefficients() const { return coefficients; }

   SurfacePoint operator()(mfem::real_t xi, mfem::real_t eta) const;
   BentSurfacePoint Bent(mfem::real_t xi, mfem::real_t eta) const;

private:
   Point3 Coefficient(int power) const
   {
      const mfem::real_t *c = coefficients.Data() + 3 * power;
      return {c[0], c[1], c[2]};
   }

   int order = 0;
   bool complete = false;
   mfem::IntegrationPoint center;
   mfem::DenseMatrix coefficients;
};

} // namespace synovia
