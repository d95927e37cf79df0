#include "synovia/mesh/element_measure.hpp"

namespace synovia
{

using namespace mfem;

real_t Measure(ElementTransformation &trans)
{
   const IntegrationRule &rule =
      IntRules.Get(trans.GetGeometryType(), trans.OrderW() + 2);
   real_t measure = 0.0;
   for (int q = 0; q < rule.GetNPoints(); q++)
   {
      trans.SetIntPoint(&rule.IntPoint(q));
      measure += rule.IntPoint(q).weight * trans.Weight();
   }
   return measure;
}

} // namespace synovia
