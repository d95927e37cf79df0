#include "synovia/fem/corner_barrier.hpp"
#include "synovia/fem/gradient_contraction.hpp"
#include "synovia/materials/tangent3.hpp"

#include <limits>

namespace synovia
{

using namespace mfem;

namespace
{
// Of an element's volume, what all corners stand for.
constexpr real_t corner_share = 0.01;
} // namespace

CornerBarrier::CornerBarrier(BiphasicSpaces &spaces_,
                             const MaterialTable &materials_)
   : spaces(spaces_), materials(materials_),
     corners(spaces, ElementPoints::corners)
{
}

void CornerBarrier::Set(int element, const Vector &u, const Vector &p)
{
   const Mesh &mesh = spaces.GetMesh();
   material = &materials.Get(mesh.GetAttribute(element));
   if (mesh.GetElementGeometry(element) == Geometry::TETRAHEDRON ||
       !material->HasFluid())
   {
      material = nullptr;
      return;
   }
   corners.Set(element, u, p);
}

CornerBarrier::Resistance CornerBarrier::ResistanceAt(int corner,
                                                      real_t J) const
{
   if (!(J > 0.0))
   {
      constexpr real_t none = std::numeric_limits<real_t>::quiet_NaN();
      return {none, none};
   }
   const real_t phi = material->solid_fraction;
   const real_t ratio = phi / J;
   if (ratio <= 1.0)
   {
      return {0.0, 0.0};
   }
   const real_t scale = corner_share * corners.Weight(corner) *
                        material->solid->AggregateModulus() * phi / (J * J);
   return {-3.0 * scale * (ratio - 1.0) * (ratio - 1.0),
           6.0 * scale / J * (ratio - 1.0) * (2.0 * ratio - 1.0)};
}

void CornerBarrier::AddForces(Vector &forces)
{
   for (int c = 0; Applies() && c < corners.Points(); c++)
   {
      const Tensor3<> F = corners.DeformationGradient(c);
      const Tensor3<> cofactor = Cofactor(F);
      const real_t stress = ResistanceAt(c, Determinant(F, cofactor)).stress;
      if (stress != 0.0)
      {
         const DenseMatrix &gradients = corners.Gradients();
         at_nodes.SetSize(3 * gradients.Height());
         ContractGradients(stress * cofactor, gradients, c, at_nodes.GetData());
         forces.AddElementVector(corners.DisplacementDofs(), at_nodes);
      }
   }
}

void CornerBarrier::AddTangent(DenseMatrix &stiffness)
{
   for (int c = 0; Applies() && c < corners.Points(); c++)
   {
      const Tensor3<> F = corners.DeformationGradient(c);
      const Tensor3<> cofactor = Cofactor(F);
      const Resistance resistance = ResistanceAt(c, Determinant(F, cofactor));
      if (resistance.stress == 0.0)
      {
         continue;
      }
      Tangent3 tangent = resistance.stress * CofactorDerivative(F);
      AddDyad(resistance.derivative, cofactor, cofactor, tangent);
      const DenseMatrix &gradients = corners.Gradients();
      const int nodes = gradients.Height();
      at_nodes.SetSize(3 * nodes);
      for (int k = 0; k < 9; k++)
      {
         ContractGradients(ComponentDerivative(tangent, k), gradients, c,
                           at_nodes.GetData());
         const real_t *const gradient = gradients.GetColumn(3 * c + k % 3);
         for (int j = 0; j < 3 * nodes; j++)
         {
            for (int i = 0; i < nodes; i++)
            {
               stiffness(k / 3 * nodes + i, j) += gradient[i] * at_nodes[j];
            }
         }
      }
   }
}

std::optional<CornerBarrier::Inverted> CornerBarrier::FindInverted()
{
   for (int c = 0; Applies() && c < corners.Points(); c++)
   {
      const real_t J = det(corners.DeformationGradient(c));
      if (!(J > 0.0))
      {
         return Inverted{corners.Position(c), J};
      }
   }
   return std::nullopt;
}

} // namespace synovia
