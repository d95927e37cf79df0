#include "synovia/fem/element_permeability.hpp"
#include "synovia/fem/gradient_contraction.hpp"
#include "synovia/materials/tangent3.hpp"

#include <cmath>

namespace synovia
{

using namespace mfem;

void ElementPermeability::Set(const BodyElement &element)
{
   ratios.resize(element.Points());
   volume = 0.0;
   real_t deformed = 0.0;
   for (int q = 0; q < element.Points(); q++)
   {
      ratios[q] = det(element.DeformationGradient(q));
      volume += element.Weight(q);
      deformed += element.Weight(q) * ratios[q];
   }
   mean = deformed / volume;
}

real_t ElementPermeability::Stretch(int point) const
{
   return has_mean ? std::cbrt(mean / ratios[point]) : 1.0;
}

bool ElementPermeability::Get(BodyElement &element, const PermeabilityLaw &law,
                              int point, Tensor3<> &permeability) const
{
   return law.GetReferential(
      element.Point(point), Stretch(point) * element.DeformationGradient(point),
      permeability, nullptr);
}

bool ElementPermeability::Linearize(BodyElement &element,
                                    const PermeabilityLaw &law, int point,
                                    Tensor3<> &permeability, Tangent3 &by_F,
                                    Tensor3<> &by_mean) const
{
   const Tensor3<> F = element.DeformationGradient(point);
   const real_t stretch = Stretch(point);
   const Tensor3<> mean_F = stretch * F;
   if (!law.GetReferential(element.Point(point), mean_F, permeability, &by_F))
   {
      return false;
   }
   if (has_mean)
   {
      // d(mean F) = stretch dF - mean F (cof F : dF) / (3 J)
      //             + mean F dtheta / (3 theta)
      const Tensor3<> along = AlongDeformation(by_F, mean_F);
      by_F = stretch * by_F;
      AddDyad(-1.0 / (3.0 * ratios[point]), along, Cofactor(F), by_F);
      by_mean = (1.0 / (3.0 * mean)) * along;
   }
   return true;
}

void ElementPermeability::GetMeanChange(BodyElement &element,
                                        Vector &change) const
{
   const DenseMatrix &gradients = element.Gradients();
   change.SetSize(3 * gradients.Height());
   change = 0.0;
   Vector at_point(change.Size());
   for (int q = 0; q < element.Points(); q++)
   {
      ContractGradients(Cofactor(element.DeformationGradient(q)), gradients, q,
                        at_point.GetData());
      change.Add(element.Weight(q) / volume, at_point);
   }
}

} // namespace synovia
