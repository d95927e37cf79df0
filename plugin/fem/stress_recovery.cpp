#include "synovia/fem/stress_recovery.hpp"

#include <memory>

namespace synovia
{

using namespace mfem;

namespace
{
constexpr int components = 6;

/// Adds up what the ranks have for each shared degree of freedom.
void SumOverRanks(const ParFiniteElementSpace &space, Vector &dofs)
{
   const Operator &prolongation = *space.GetProlongationMatrix();
   Vector true_dofs(space.GetTrueVSize());
   prolongation.MultTranspose(dofs, true_dofs);
   prolongation.Mult(true_dofs, dofs);
   dofs.HostReadWrite();
}

/// Voigt strain with engineering shear.
void CalcStrain(const DenseMatrix &gradient, Vector &strain)
{
   strain(0) = gradient(0, 0);
   strain(1) = gradient(1, 1);
   strain(2) = gradient(2, 2);
   strain(3) = gradient(0, 1) + gradient(1, 0);
   strain(4) = gradient(1, 2) + gradient(2, 1);
   strain(5) = gradient(0, 2) + gradient(2, 0);
}

/// P F^T / J
void CalcCauchyStress(const SolidLaw &law, const MaterialPoint &point,
                      const DenseMatrix &gradient, Vector &stress)
{
   Tensor3<> F = IdentityTensor();
   for (int i = 0; i < 3; i++)
   {
      for (int j = 0; j < 3; j++)
      {
         F[i][j] += gradient(i, j);
      }
   }
   Tensor3<> P;
   law.GetStress(point, F, P, nullptr);
   const real_t J = Determinant(F, Cofactor(F));
   constexpr int voigt[components][2] = {{0, 0}, {1, 1}, {2, 2},
                                         {0, 1}, {1, 2}, {0, 2}};
   for (int v = 0; v < components; v++)
   {
      const auto &row = P[voigt[v][0]];
      const auto &line = F[voigt[v][1]];
      stress(v) = (row[0] * line[0] + row[1] * line[1] + row[2] * line[2]) / J;
   }
}
} // namespace

StressRecovery::StressRecovery(ParFiniteElementSpace &displacement,
                               const MaterialTable &materials_,
                               Deformation deformation_)
   : materials(materials_), deformation(deformation_), strain(components),
     tensors(displacement.GetParMesh(), displacement.FEColl(), components),
     vectors(displacement.GetParMesh(), displacement.FEColl(), 3),
     effective(&tensors), total(&tensors), principal(&vectors),
     elements_of_dof(tensors.GetVSize())
{
   effective = 0.0;
   total = 0.0;
   principal = 0.0;
   elements_of_dof = 0.0;
   Array<int> dofs;
   for (int e = 0; e < tensors.GetNE(); e++)
   {
      tensors.GetElementVDofs(e, dofs);
      for (const int dof : dofs)
      {
         elements_of_dof(dof) += 1.0;
      }
   }
   SumOverRanks(tensors, elements_of_dof);
}

const StressRecovery::Extrapolation &
StressRecovery::ExtrapolationOf(const FiniteElement &element)
{
   const Geometry::Type geometry = element.GetGeomType();
   const auto known = extrapolations.find(geometry);
   if (known != extrapolations.end())
   {
      return known->second;
   }
   const int order = element.GetOrder() - 1;
   const L2_FECollection polynomials(order, 3);
   const FiniteElement &fit = *polynomials.FiniteElementForGeometry(geometry);
   const IntegrationRule &rule = IntRules.Get(geometry, 2 * order);
   const IntegrationRule &nodes = element.GetNodes();

   // Least squares on the reference element: the fit's values at the nodes are
   // N (sum_q w phi phi^T)^-1 (w phi), and exact for polynomials of its order.
   Vector shape(fit.GetDof());
   DenseMatrix moments(fit.GetDof(), rule.GetNPoints());
   DenseMatrix mass(fit.GetDof());
   mass = 0.0;
   for (int q = 0; q < rule.GetNPoints(); q++)
   {
      fit.CalcShape(rule.IntPoint(q), shape);
      AddMult_a_VVt(rule.IntPoint(q).weight, shape, mass);
      shape *= rule.IntPoint(q).weight;
      moments.SetCol(q, shape);
   }
   DenseMatrix at_nodes(nodes.GetNPoints(), fit.GetDof());
   for (int i = 0; i < nodes.GetNPoints(); i++)
   {
      fit.CalcShape(nodes.IntPoint(i), shape);
      at_nodes.SetRow(i, shape);
   }
   DenseMatrixInverse(mass).Mult(DenseMatrix(moments), moments);
   Extrapolation made{&rule,
                      DenseMatrix(nodes.GetNPoints(), rule.GetNPoints())};
   Mult(at_nodes, moments, made.to_nodes);
   return extrapolations.emplace(geometry, made).first->second;
}

void StressRecovery::Average(ParGridFunction &field) const
{
   SumOverRanks(tensors, field);
   for (int i = 0; i < field.Size(); i++)
   {
      field(i) /= elements_of_dof(i);
   }
}

void StressRecovery::GetStress(const SolidLaw &law, const MaterialPoint &point,
                               const DenseMatrix &gradient, Vector &stress)
{
   if (deformation == Deformation::infinitesimal)
   {
      law.GetStiffness(point.trans, point.ip, stiffness);
      CalcStrain(gradient, strain);
      stiffness.Mult(strain, stress);
      return;
   }
   CalcCauchyStress(law, point, gradient, stress);
}

void StressRecovery::Update(const ParGridFunction &u, const ParGridFunction &p)
{
   effective = 0.0;
   total = 0.0;
   IsoparametricTransformation trans;
   DenseMatrix gradient;
   DenseMatrix at_points;
   DenseMatrix at_nodes;
   Vector stress(components);
   Array<int> dofs;
   const ParMesh &mesh = *tensors.GetParMesh();
   for (int e = 0; e < tensors.GetNE(); e++)
   {
      const FiniteElement &element = *tensors.GetFE(e);
      const Extrapolation &extrapolation = ExtrapolationOf(element);
      const IntegrationRule &rule = *extrapolation.rule;
      mesh.GetElementTransformation(e, &trans);
      const SolidLaw &law = *materials.Get(trans.Attribute).solid;
      at_points.SetSize(rule.GetNPoints(), components);
      for (int q = 0; q < rule.GetNPoints(); q++)
      {
         const IntegrationPoint &ip = rule.IntPoint(q);
         trans.SetIntPoint(&ip);
         u.GetVectorGradient(trans, gradient);
         GetStress(law, {trans, ip}, gradient, stress);
         at_points.SetRow(q, stress);
      }
      const int nodes = element.GetDof();
      at_nodes.SetSize(nodes, components);
      Mult(extrapolation.to_nodes, at_points, at_nodes);
      // An element's dofs go component by component, as the matrix does.
      const Vector element_values(at_nodes.GetData(), nodes * components);
      tensors.GetElementVDofs(e, dofs);
      effective.AddElementVector(dofs, element_values);
      for (int i = 0; i < nodes; i++)
      {
         const real_t pressure = p.GetValue(e, element.GetNodes().IntPoint(i));
         for (int c = 0; c < 3; c++)
         {
            at_nodes(i, c) -= pressure;
         }
      }
      total.AddElementVector(dofs, element_values);
   }
   Average(effective);
   Average(total);

   principal.HostWrite();
   DenseMatrix tensor(3);
   const int nodes = tensors.GetNDofs();
   for (int i = 0; i < nodes; i++)
   {
      const auto at = [&](int c) { return total(tensors.DofToVDof(i, c)); };
      tensor(0, 0) = at(0);
      tensor(1, 1) = at(1);
      tensor(2, 2) = at(2);
      tensor(0, 1) = tensor(1, 0) = at(3);
      tensor(1, 2) = tensor(2, 1) = at(4);
      tensor(0, 2) = tensor(2, 0) = at(5);
      real_t values[3];
      real_t directions[9];
      tensor.CalcEigenvalues(values, directions);
      for (int c = 0; c < 3; c++)
      {
         principal(vectors.DofToVDof(i, c)) = values[2 - c];
      }
   }
}

} // namespace synovia
