#pragma once

#include "mfem.hpp"

#include <vector>

namespace synovia
{

/// Points of the reference element that tell whether a map of this order is
/// one to one: corners, nodal points and quadrature points. The apex of a
/// pyramid is left out, where the Jacobian of any map is singular.
mfem::IntegrationRule JacobianPoints(mfem::Geometry::Type geometry, int order);

/// The Jacobians of many elements at the same points. Faster than their
/// ElementTransformations, since the gradients are evaluated once.
class JacobianSamples
{
public:
   /// For maps by this finite element.
   JacobianSamples(const mfem::FiniteElement &element,
                   const mfem::IntegrationRule &points);

   int Size() const { return static_cast<int>(gradients.size()); }

   /// The Jacobian at a point, 3 x 3, of the map with these nodes (3 x nodes),
   /// as IsoparametricTransformation::GetPointMat() has them.
   void Evaluate(const mfem::DenseMatrix &nodes, int point,
                 mfem::DenseMatrix &jacobian) const
   {
      jacobian.SetSize(3);
      mfem::Mult(nodes, gradients[point], jacobian);
   }

private:
   std::vector<mfem::DenseMatrix> gradients;
};

} // namespace synovia
