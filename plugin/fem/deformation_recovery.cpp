#include "synovia/fem/deformation_recovery.hpp"
#include "synovia/fem/principal_strain.hpp"
#include "synovia/materials/tensor3.hpp"

#include <cmath>

namespace synovia
{

using namespace mfem;

namespace
{
constexpr int strain_components = 6;
// The solid fraction where there is no fluid.
constexpr real_t no_pores = 1.0;

// ln U, by its principal axes, which are those of Green's strain.
void CalcLogarithmicStrain(const DenseMatrix &gradient, Vector &strain)
{
   real_t green[3];
   real_t axes[9]; // one after the other
   GreenStrain(gradient).CalcEigenvalues(green, axes);
   strain = 0.0;
   for (int k = 0; k < 3; k++)
   {
      const real_t along = LogarithmicStrain(green[k]);
      for (int v = 0; v < strain_components; v++)
      {
         strain(v) += along * axes[3 * k + symmetric_entries[v][0]] *
                      axes[3 * k + symmetric_entries[v][1]];
      }
   }
}
} // namespace

DeformationRecovery::DeformationRecovery(ParFiniteElementSpace &displacement,
                                         const MaterialTable &materials)
   : recovery(displacement, strain_components),
     vectors(displacement.GetParMesh(), displacement.FEColl(), 3),
     scalars(displacement.GetParMesh(), displacement.FEColl()),
     strain(&recovery.Space()), principal(&vectors), volume_ratio(&scalars),
     porosity(&scalars), solid_fractions(SolidFractions(materials))
{
   principal = 0.0;
   volume_ratio = 1.0;
   for (int i = 0; i < porosity.Size(); i++)
   {
      porosity(i) = 1.0 - solid_fractions(i);
   }
}

Vector DeformationRecovery::SolidFractions(const MaterialTable &materials)
{
   ParFiniteElementSpace &space = recovery.Space();
   DenseMatrix at_nodes;
   strain = 0.0;
   for (int e = 0; e < space.GetNE(); e++)
   {
      at_nodes.SetSize(space.GetFE(e)->GetDof(), strain_components);
      const Material &material =
         materials.Get(space.GetParMesh()->GetAttribute(e));
      at_nodes = material.HasFluid() ? material.solid_fraction : no_pores;
      recovery.Add(e, at_nodes, strain);
   }
   recovery.Average(strain);
   Vector fractions(scalars.GetVSize());
   for (int i = 0; i < fractions.Size(); i++)
   {
      fractions(i) = strain(space.DofToVDof(i, 0));
   }
   return fractions;
}

void DeformationRecovery::Update(const ParGridFunction &u)
{
   ParFiniteElementSpace &space = recovery.Space();
   const ParMesh &mesh = *space.GetParMesh();
   IsoparametricTransformation trans;
   DenseMatrix gradient;
   DenseMatrix at_points;
   DenseMatrix at_nodes;
   Vector at_point(strain_components);
   strain = 0.0;
   for (int e = 0; e < space.GetNE(); e++)
   {
      const IntegrationRule &rule = recovery.Points(e);
      mesh.GetElementTransformation(e, &trans);
      at_points.SetSize(rule.GetNPoints(), strain_components);
      for (int q = 0; q < rule.GetNPoints(); q++)
      {
         trans.SetIntPoint(&rule.IntPoint(q));
         u.GetVectorGradient(trans, gradient);
         CalcLogarithmicStrain(gradient, at_point);
         at_points.SetRow(q, at_point);
      }
      recovery.ToNodes(e, at_points, at_nodes);
      recovery.Add(e, at_nodes, strain);
   }
   recovery.Average(strain);

   principal.HostWrite();
   volume_ratio.HostWrite();
   porosity.HostWrite();
   DenseMatrix tensor(3);
   for (int i = 0; i < space.GetNDofs(); i++)
   {
      for (int v = 0; v < strain_components; v++)
      {
         tensor(symmetric_entries[v][0], symmetric_entries[v][1]) =
            tensor(symmetric_entries[v][1], symmetric_entries[v][0]) =
               strain(space.DofToVDof(i, v));
      }
      real_t values[3];
      real_t directions[9];
      tensor.CalcEigenvalues(values, directions);
      for (int c = 0; c < 3; c++)
      {
         principal(vectors.DofToVDof(i, c)) = values[2 - c];
      }
      volume_ratio(i) = std::exp(tensor.Trace());
      porosity(i) = solid_fractions(i) < no_pores
                       ? 1.0 - solid_fractions(i) / volume_ratio(i)
                       : 0.0;
   }
}

} // namespace synovia
