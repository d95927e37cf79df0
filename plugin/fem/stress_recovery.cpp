#include "synovia/fem/stress_recovery.hpp"

namespace synovia
{

using namespace mfem;

namespace
{
constexpr int stress_components = 6;

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
   for (int v = 0; v < stress_components; v++)
   {
      const auto &row = P[symmetric_entries[v][0]];
      const auto &line = F[symmetric_entries[v][1]];
      stress(v) = (row[0] * line[0] + row[1] * line[1] + row[2] * line[2]) / J;
   }
}
} // namespace

StressRecovery::StressRecovery(ParFiniteElementSpace &displacement,
                               const MaterialTable &materials_,
                               Deformation deformation_)
   : materials(materials_), deformation(deformation_),
     strain(stress_components), recovery(displacement, stress_components),
     tensors(recovery.Space()),
     vectors(displacement.GetParMesh(), displacement.FEColl(), 3),
     effective(&tensors), total(&tensors), principal(&vectors)
{
   effective = 0.0;
   total = 0.0;
   principal = 0.0;
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
   Vector stress(stress_components);
   const ParMesh &mesh = *tensors.GetParMesh();
   for (int e = 0; e < tensors.GetNE(); e++)
   {
      const IntegrationRule &rule = recovery.Points(e);
      mesh.GetElementTransformation(e, &trans);
      const Material &material = materials.Get(trans.Attribute);
      if (material.IsRigid())
      {
         continue;
      }
      const SolidLaw &law = *material.solid;
      at_points.SetSize(rule.GetNPoints(), stress_components);
      for (int q = 0; q < rule.GetNPoints(); q++)
      {
         const IntegrationPoint &ip = rule.IntPoint(q);
         trans.SetIntPoint(&ip);
         u.GetVectorGradient(trans, gradient);
         GetStress(law, {trans, ip}, gradient, stress);
         at_points.SetRow(q, stress);
      }
      recovery.ToNodes(e, at_points, at_nodes);
      recovery.Add(e, at_nodes, effective);
      const IntegrationRule &nodes = tensors.GetFE(e)->GetNodes();
      for (int i = 0; material.HasFluid() && i < nodes.GetNPoints(); i++)
      {
         const real_t pressure = p.GetValue(e, nodes.IntPoint(i));
         for (int c = 0; c < 3; c++)
         {
            at_nodes(i, c) -= pressure;
         }
      }
      recovery.Add(e, at_nodes, total);
   }
   recovery.Average(effective);
   recovery.Average(total);

   principal.HostWrite();
   for (int i = 0; i < tensors.GetNDofs(); i++)
   {
      real_t values[3];
      real_t directions[9];
      TotalAt(i).CalcEigenvalues(values, directions);
      for (int c = 0; c < 3; c++)
      {
         principal(vectors.DofToVDof(i, c)) = values[2 - c];
      }
   }
}

DenseMatrix StressRecovery::TotalAt(int node) const
{
   const auto at = [&](int c) { return total(tensors.DofToVDof(node, c)); };
   DenseMatrix tensor(3);
   tensor(0, 0) = at(0);
   tensor(1, 1) = at(1);
   tensor(2, 2) = at(2);
   tensor(0, 1) = tensor(1, 0) = at(3);
   tensor(1, 2) = tensor(2, 1) = at(4);
   tensor(0, 2) = tensor(2, 0) = at(5);
   return tensor;
}

void StressRecovery::GetDirections(ParGridFunction &largest,
                                   ParGridFunction &smallest) const
{
   largest.HostWrite();
   smallest.HostWrite();
   for (int i = 0; i < tensors.GetNDofs(); i++)
   {
      real_t values[3];
      real_t directions[9]; // one after the other, of the smallest first
      TotalAt(i).CalcEigenvalues(values, directions);
      for (int c = 0; c < 3; c++)
      {
         smallest(vectors.DofToVDof(i, c)) = directions[c];
         largest(vectors.DofToVDof(i, c)) = directions[6 + c];
      }
   }
}

} // namespace synovia
