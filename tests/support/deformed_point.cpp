#include "support/deformed_point.hpp"

#include <catch2/catch.hpp>

#include <cmath>

namespace synovia
{

using namespace mfem;

AnyPoint::AnyPoint()
   : mesh(Mesh::MakeCartesian3D(1, 1, 1, Element::HEXAHEDRON)),
     trans(*mesh.GetElementTransformation(0)),
     ip(Geometries.GetCenter(Geometry::CUBE))
{
   trans.SetIntPoint(&ip);
}

Tensor3<> SomeDeformation()
{
   return {{{1.10, 0.20, -0.05}, {0.10, 0.90, 0.15}, {-0.10, 0.05, 1.05}}};
}

Vector3<> SomeDirection()
{
   return {std::cos(0.3) * std::cos(0.2), std::sin(0.3) * std::cos(0.2),
           std::sin(0.2)};
}

Tensor3<> SomeRotation()
{
   const real_t c = std::cos(0.7);
   const real_t s = std::sin(0.7);
   const Tensor3<> about_z{{{c, -s, 0.0}, {s, c, 0.0}, {0.0, 0.0, 1.0}}};
   const Tensor3<> about_x{{{1.0, 0.0, 0.0}, {0.0, c, -s}, {0.0, s, c}}};
   return Product(about_z, about_x);
}

Tensor3<> PushedForward(const Tensor3<> &A, const Tensor3<> &B)
{
   const real_t determinant = Determinant(B, Cofactor(B));
   Tensor3<> forward;
   for (int i = 0; i < 3; i++)
   {
      for (int j = 0; j < 3; j++)
      {
         forward[i][j] =
            (A[i][0] * B[j][0] + A[i][1] * B[j][1] + A[i][2] * B[j][2]) /
            determinant;
      }
   }
   return forward;
}

void CheckDerivative(const TensorFunction &function, const Tensor3<> &F)
{
   constexpr real_t step = 1e-6;
   Tensor3<> value;
   Tensor3<> alone;
   Tangent3 tangent;
   REQUIRE(function(F, value, &tangent));
   REQUIRE(function(F, alone, nullptr));
   CHECK(AreClose(value, alone, 1e-14));
   real_t largest = 0.0;
   for (int k = 0; k < 9; k++)
   {
      for (int l = 0; l < 9; l++)
      {
         largest = std::max(largest, std::abs(tangent[k][l]));
      }
   }
   REQUIRE(largest > 0.0);
   for (int l = 0; l < 9; l++)
   {
      Tensor3<> ahead = F;
      Tensor3<> behind = F;
      ahead[l / 3][l % 3] += step;
      behind[l / 3][l % 3] -= step;
      Tensor3<> ahead_value;
      Tensor3<> behind_value;
      REQUIRE(function(ahead, ahead_value, nullptr));
      REQUIRE(function(behind, behind_value, nullptr));
      for (int k = 0; k < 9; k++)
      {
         CAPTURE(k, l);
         const real_t difference =
            (ahead_value[k / 3][k % 3] - behind_value[k / 3][k % 3]) /
            (2.0 * step);
         CHECK(std::abs(tangent[k][l] - difference) < 2e-9 * largest);
      }
   }
}

bool AreClose(const Tensor3<> &a, const Tensor3<> &b, real_t tolerance)
{
   real_t largest = 0.0;
   real_t difference = 0.0;
   for (int k = 0; k < 9; k++)
   {
      largest = std::max(largest, std::abs(a[k / 3][k % 3]));
      difference =
         std::max(difference, std::abs(a[k / 3][k % 3] - b[k / 3][k % 3]));
   }
   return largest > 0.0 && difference <= tolerance * largest;
}

} // namespace synovia
