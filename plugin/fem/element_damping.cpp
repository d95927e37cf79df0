#include "synovia/fem/element_damping.hpp"
#include "synovia/general/reduce.hpp"

#include <algorithm>
#include <cmath>

namespace synovia
{

using namespace mfem;

namespace
{
constexpr real_t first_level = 0.25;
constexpr real_t raising_factor = 4.0;
constexpr real_t lowering_factor = 0.5;
constexpr real_t least_level = 0.1;
// Elements hardly move by then.
constexpr real_t largest_level = 1024.0;
} // namespace

ElementDamping::ElementDamping(BiphasicSpaces &spaces_,
                               const MaterialTable &materials_,
                               BodyElement &element_)
   : spaces(spaces_), materials(materials_), element(element_)
{
}

real_t ElementDamping::LargestStrain(int number, const Vector &u,
                                     const Vector &p,
                                     const Vector &direction) const
{
   element.Set(number, u, p);
   Vector values;
   direction.GetSubVector(element.DisplacementDofs(), values);
   const DenseMatrix &gradients = element.Gradients();
   const int nodes = gradients.Height();
   real_t largest = 0.0;
   for (int q = 0; q < element.Points(); q++)
   {
      Tensor3<> change{};
      for (int a = 0; a < 3; a++)
      {
         for (int c = 0; c < 3; c++)
         {
            const real_t *const gradient = gradients.GetColumn(3 * q + c);
            for (int k = 0; k < nodes; k++)
            {
               change[a][c] += values[a * nodes + k] * gradient[k];
            }
         }
      }
      const Tensor3<> F = element.DeformationGradient(q);
      const Tensor3<> cofactor = Cofactor(F);
      const real_t J = Determinant(F, cofactor);
      real_t squares = 0.0;
      for (int a = 0; a < 3; a++)
      {
         for (int b = 0; b < 3; b++)
         {
            real_t strain = 0.0;
            for (int c = 0; c < 3; c++)
            {
               strain += 0.5 * (change[a][c] * cofactor[b][c] +
                                change[b][c] * cofactor[a][c]);
            }
            squares += strain * strain;
         }
      }
      largest = std::max(largest, std::sqrt(squares) / J);
   }
   return largest;
}

bool ElementDamping::Raise(const Vector &u, const Vector &p,
                           const Vector &direction)
{
   // No tangent is worth much farther than that.
   constexpr real_t too_much = 0.3;
   bool any = false;
   for (int e = 0; e < spaces.GetMesh().GetNE(); e++)
   {
      if (materials.Get(spaces.GetMesh().GetAttribute(e)).IsRigid() ||
          LargestStrain(e, u, p, direction) <= too_much)
      {
         continue;
      }
      const auto damped = levels.emplace(e, first_level / raising_factor).first;
      any = any || damped->second < largest_level;
      damped->second = std::min(raising_factor * damped->second, largest_level);
   }
   return AnyRank(any, spaces.GetComm());
}

void ElementDamping::Lower()
{
   for (auto damped = levels.begin(); damped != levels.end();)
   {
      damped->second *= lowering_factor;
      damped = damped->second < least_level ? levels.erase(damped)
                                            : std::next(damped);
   }
}

void ElementDamping::AddTangent(int number, const Vector &u, const Vector &p,
                                DenseMatrix &stiffness)
{
   const auto damped = levels.find(number);
   if (damped == levels.end())
   {
      return;
   }
   element.Set(number, u, p);
   const Material &material = materials.Get(element.Attribute());
   real_t pressure = 0.0;
   for (int q = 0; material.HasFluid() && q < element.Points(); q++)
   {
      pressure = std::max(pressure, std::abs(element.Pressure(q)));
   }
   const real_t stress =
      damped->second * (pressure + 2.0 * material.solid->ShearModulus());
   const DenseMatrix &gradients = element.Gradients();
   const int nodes = gradients.Height();
   DenseMatrix &matrix = matrices[number];
   matrix.SetSize(3 * nodes);
   matrix = 0.0;
   for (int q = 0; q < element.Points(); q++)
   {
      const real_t weight = stress * std::abs(element.Weight(q));
      for (int i = 0; i < nodes; i++)
      {
         for (int j = 0; j < nodes; j++)
         {
            real_t product = 0.0;
            for (int c = 0; c < 3; c++)
            {
               product += gradients(i, 3 * q + c) * gradients(j, 3 * q + c);
            }
            for (int a = 0; a < 3; a++)
            {
               matrix(a * nodes + i, a * nodes + j) += weight * product;
            }
         }
      }
   }
   stiffness += matrix;
}

void ElementDamping::AddForces(const Vector &displacement, Vector &forces) const
{
   Array<int> dofs;
   Vector moved;
   Vector resistance;
   for (const auto &[number, matrix] : matrices)
   {
      spaces.Displacement().GetElementVDofs(number, dofs);
      displacement.GetSubVector(dofs, moved);
      resistance.SetSize(dofs.Size());
      matrix.Mult(moved, resistance);
      forces.AddElementVector(dofs, resistance);
   }
}

} // namespace synovia
