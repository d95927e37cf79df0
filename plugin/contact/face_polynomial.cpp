#include "synovia/contact/face_polynomial.hpp"

namespace synovia
{

using namespace mfem;

namespace
{
// Powers of xi that go with a power of eta.
int RowLength(int order, bool complete, int power_of_eta)
{
   return complete ? order - power_of_eta + 1 : order + 1;
}

bool IsComplete(Geometry::Type geometry)
{
   return geometry == Geometry::TRIANGLE;
}

int Powers(Geometry::Type geometry, int order)
{
   return IsComplete(geometry) ? (order + 1) * (order + 2) / 2
                               : (order + 1) * (order + 1);
}

void MultiplyAdd(Point3 &a, real_t factor, const Point3 &b)
{
   for (int d = 0; d < 3; d++)
   {
      a[d] = factor * a[d] + b[d];
   }
}

constexpr Point3 zero{{0.0, 0.0, 0.0}};
} // namespace

FacePolynomial::FacePolynomial(const FiniteElement &element)
   : FacePolynomial(element.GetGeomType(), element.GetOrder())
{
   MFEM_VERIFY(element.GetDim() == 2, "a face has two reference coordinates");
   MFEM_VERIFY(element.GetDof() == coefficients.Width(),
               "the element's shape functions are not all polynomials of its "
               "order");
}

FacePolynomial::FacePolynomial(Geometry::Type geometry, int order_)
   : order(order_), complete(IsComplete(geometry)),
     center(Geometries.GetCenter(geometry)),
     coefficients(3, Powers(geometry, order))
{
   coefficients = 0.0;
}

DenseMatrix FacePolynomial::PowersFromNodes(const FiniteElement &element)
{
   const int order = element.GetOrder();
   const bool complete = IsComplete(element.GetGeomType());
   const IntegrationPoint &center = Geometries.GetCenter(element.GetGeomType());
   const IntegrationRule &nodes = element.GetNodes();
   DenseMatrix powers(element.GetDof());
   for (int k = 0; k < nodes.GetNPoints(); k++)
   {
      const real_t s = nodes.IntPoint(k).x - center.x;
      const real_t t = nodes.IntPoint(k).y - center.y;
      int row = 0;
      real_t t_power = 1.0;
      for (int j = 0; j <= order; j++)
      {
         real_t power = t_power;
         for (int i = 0; i < RowLength(order, complete, j); i++)
         {
            powers(row++, k) = power;
            power *= s;
         }
         t_power *= t;
      }
      MFEM_VERIFY(row == powers.Height(),
                  "the element's shape functions are not all polynomials of "
                  "its order");
   }
   powers.Invert();
   return powers;
}

// Horner's scheme in eta, of polynomials in xi by Horner's scheme; each
// derivative takes up the one below before that moves on.
SurfacePoint FacePolynomial::operator()(real_t xi, real_t eta) const
{
   const real_t s = xi - center.x;
   const real_t t = eta - center.y;
   SurfacePoint point{zero, {zero, zero}};
   int end = coefficients.Width();
   for (int j = order; j >= 0; j--)
   {
      Point3 value = zero;
      Point3 slope = zero;
      for (int i = RowLength(order, complete, j); i > 0; i--)
      {
         MultiplyAdd(slope, s, value);
         MultiplyAdd(value, s, Coefficient(--end));
      }
      MultiplyAdd(point.tangents[1], t, point.position);
      MultiplyAdd(point.position, t, value);
      MultiplyAdd(point.tangents[0], t, slope);
   }
   return point;
}

BentSurfacePoint FacePolynomial::Bent(real_t xi, real_t eta) const
{
   const real_t s = xi - center.x;
   const real_t t = eta - center.y;
   BentSurfacePoint bent{{zero, {zero, zero}}, {zero, zero, zero}};
   SurfacePoint &point = bent.point;
   std::array<Point3, 3> &second = bent.second;
   int end = coefficients.Width();
   for (int j = order; j >= 0; j--)
   {
      Point3 value = zero;
      Point3 slope = zero;
      Point3 bend = zero;
      for (int i = RowLength(order, complete, j); i > 0; i--)
      {
         MultiplyAdd(bend, s, slope);
         MultiplyAdd(slope, s, value);
         MultiplyAdd(value, s, Coefficient(--end));
      }
      MultiplyAdd(second[2], t, point.tangents[1]);
      MultiplyAdd(point.tangents[1], t, point.position);
      MultiplyAdd(point.position, t, value);
      MultiplyAdd(second[1], t, point.tangents[0]);
      MultiplyAdd(point.tangents[0], t, slope);
      MultiplyAdd(second[0], t, bend);
   }
   // Horner's scheme gives derivatives divided by their factorials.
   MultiplyAdd(second[0], 2.0, zero);
   MultiplyAdd(second[2], 2.0, zero);
   return bent;
}

} // namespace synovia
