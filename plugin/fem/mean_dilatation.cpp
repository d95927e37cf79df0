#include "synovia/fem/mean_dilatation.hpp"
#include "synovia/fem/gradient_contraction.hpp"
#include "synovia/materials/tangent3.hpp"

#include <cmath>

namespace synovia
{

using namespace mfem;

namespace
{
// A : B
real_t DoubleContraction(const Tensor3<> &A, const Tensor3<> &B)
{
   real_t sum = 0.0;
   for (int i = 0; i < 3; i++)
   {
      sum += InnerProduct(A[i], B[i]);
   }
   return sum;
}

// F : dP, the sum over the first.
Tensor3<> WorkChange(const Tangent3 &tangent, const Tensor3<> &F)
{
   Tensor3<> change{};
   for (int k = 0; k < 9; k++)
   {
      for (int l = 0; l < 9; l++)
      {
         change[l / 3][l % 3] += F[k / 3][k % 3] * tangent[k][l];
      }
   }
   return change;
}
} // namespace

bool MeanDilatation::FindMean(const BodyElement &element)
{
   volume = 0.0;
   real_t deformed = 0.0;
   for (int q = 0; q < element.Points(); q++)
   {
      const real_t J = det(element.DeformationGradient(q));
      if (!(J > 0.0))
      {
         return false;
      }
      volume += element.Weight(q);
      deformed += element.Weight(q) * J;
   }
   dilatation = deformed / volume;
   return true;
}

bool MeanDilatation::Evaluate(BodyElement &element, const SolidLaw &solid)
{
   if (!FindMean(element))
   {
      return false;
   }
   stresses.resize(element.Points());
   mean_pressure = 0.0;
   for (int q = 0; q < element.Points(); q++)
   {
      if (!EvaluatePoint(element, solid, q, nullptr))
      {
         return false;
      }
   }
   for (int q = 0; q < element.Points(); q++)
   {
      stresses[q] =
         stresses[q] + mean_pressure * Cofactor(element.DeformationGradient(q));
   }
   return true;
}

bool MeanDilatation::Linearize(BodyElement &element, const SolidLaw &solid)
{
   if (!FindMean(element))
   {
      return false;
   }
   const int points = element.Points();
   stresses.resize(points);
   tangents.resize(points);
   stress_changes.resize(points);
   pressure_changes.resize(points);
   mean_pressure = 0.0;
   curvature = 0.0;
   for (int q = 0; q < points; q++)
   {
      Tangent3 tangent;
      if (!EvaluatePoint(element, solid, q, &tangent))
      {
         return false;
      }
   }
   for (int q = 0; q < points; q++)
   {
      const Tensor3<> F = element.DeformationGradient(q);
      stresses[q] = stresses[q] + mean_pressure * Cofactor(F);
      tangents[q] += mean_pressure * CofactorDerivative(F);
   }
   return true;
}

bool MeanDilatation::EvaluatePoint(BodyElement &element, const SolidLaw &solid,
                                   int q, Tangent3 *tangent)
{
   const Tensor3<> F = element.DeformationGradient(q);
   const Tensor3<> C = Cofactor(F);
   const real_t J = Determinant(F, C);
   const real_t stretch = std::cbrt(dilatation / J);
   const Tensor3<> mean_F = stretch * F;
   Tensor3<> P;
   if (!solid.GetStress(element.Point(q), mean_F, P, tangent))
   {
      return false;
   }
   // Derivatives of theta: d(mean F) = mean F / (3 theta); of F:
   // stretch dF - mean F (C : dF) / (3 J).
   const real_t by_theta = 1.0 / (3.0 * dilatation);
   const real_t by_J = 1.0 / (3.0 * J);
   const real_t share = element.Weight(q) / volume;
   const real_t work = DoubleContraction(P, mean_F);
   stresses[q] = stretch * P - (work * by_J) * C;
   mean_pressure += share * work * by_theta;
   if (tangent)
   {
      const Tensor3<> along = P + AlongDeformation(*tangent, mean_F);
      const Tensor3<> work_change = P + WorkChange(*tangent, mean_F);
      const real_t second = DoubleContraction(work_change, mean_F);
      Tangent3 &total = tangents[q];
      total = (stretch * stretch) * *tangent;
      total -= (work * by_J) * CofactorDerivative(F);
      AddDyad(-stretch * by_J, along, C, total);
      AddDyad(-stretch * by_J, C, work_change, total);
      AddDyad((second + 3.0 * work) * by_J * by_J, C, C, total);
      stress_changes[q] = by_theta * (stretch * along - (second * by_J) * C);
      pressure_changes[q] =
         by_theta * (stretch * work_change - (second * by_J) * C);
      curvature +=
         element.Weight(q) * (second - 3.0 * work) * by_theta * by_theta;
   }
   return true;
}

void MeanDilatation::AddCoupling(BodyElement &element, DenseMatrix &stiffness)
{
   const int dofs = stiffness.Height();
   Vector dilatation_change(dofs);
   Vector force_change(dofs);
   Vector pressure_change(dofs);
   Vector at_point(dofs);
   dilatation_change = 0.0;
   force_change = 0.0;
   pressure_change = 0.0;
   const auto add = [&](const Tensor3<> &A, int q, real_t factor, Vector &sum)
   {
      ContractGradients(A, element.Gradients(), q, at_point.GetData());
      sum.Add(factor, at_point);
   };
   for (int q = 0; q < element.Points(); q++)
   {
      const real_t weight = element.Weight(q);
      add(Cofactor(element.DeformationGradient(q)), q, weight / volume,
          dilatation_change);
      add(stress_changes[q], q, weight, force_change);
      add(pressure_changes[q], q, weight, pressure_change);
   }
   pressure_change.Add(curvature, dilatation_change);
   AddMultVWt(force_change, dilatation_change, stiffness);
   AddMultVWt(dilatation_change, pressure_change, stiffness);
}

} // namespace synovia
