#include "synovia/mesh/jacobian_samples.hpp"

namespace synovia
{

using namespace mfem;

IntegrationRule JacobianPoints(Geometry::Type geometry, int order)
{
   const H1_FECollection nodal(order, 3);
   const IntegrationRule *const sources[] = {
      Geometries.GetVertices(geometry),
      &nodal.FiniteElementForGeometry(geometry)->GetNodes(),
      &IntRules.Get(geometry, 3 * order)};
   IntegrationRule points;
   for (const IntegrationRule *source : sources)
   {
      for (int i = 0; i < source->GetNPoints(); i++)
      {
         const IntegrationPoint &point = source->IntPoint(i);
         if (geometry != Geometry::PYRAMID || point.z < 1.0 - 1e-6)
         {
            points.Append(point);
         }
      }
   }
   return points;
}

JacobianSamples::JacobianSamples(const FiniteElement &element,
                                 const IntegrationRule &points)
{
   for (int i = 0; i < points.GetNPoints(); i++)
   {
      gradients.emplace_back(element.GetDof(), element.GetDim());
      element.CalcDShape(points.IntPoint(i), gradients.back());
   }
}

} // namespace synovia
