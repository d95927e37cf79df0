#pragma once

#include "synovia/fem/body_element.hpp"
#include "synovia/materials/permeability_law.hpp"

namespace synovia
{

/// The referential permeability in elements of a deforming body. With
/// displacements of order 1 it sees one change of volume, the mean over the
/// undeformed element:
///
///     K = K((theta / J)^(1/3) F),  theta = int J / int 1
///
/// as the pressure of order 1 governs the element's volume and not that at its
/// points: pores would close at single points of an element that bends. With
/// displacements of order 2 and more, K = K(F).
class ElementPermeability
{
public:
   explicit ElementPermeability(const BiphasicSpaces &spaces)
      : has_mean(spaces.Order() == 1)
   {
   }

   /// Takes the volume ratios of the element that @a element is set to, which
   /// the calls after it are about.
   void Set(const BodyElement &element);
   /// What K sees at a point.
   mfem::real_t VolumeRatio(int point) const
   {
      return has_mean ? mean : ratios[point];
   }
   /// Sets K at a point; false where the law has no value.
   bool Get(BodyElement &element, const PermeabilityLaw &law, int point,
            Tensor3<> &permeability) const;

   /// Sets K, its derivative by F at the same point and, if HasMean(), that by
   /// the mean; false where the law has no value.
   bool Linearize(BodyElement &element, const PermeabilityLaw &law, int point,
                  Tensor3<> &permeability, Tangent3 &by_F,
                  Tensor3<> &by_mean) const;
   bool HasMean() const { return has_mean; }
   /// Sets the derivative of the mean by the displacement's dofs, component by
   /// component.
   void GetMeanChange(BodyElement &element, mfem::Vector &change) const;

private:
   /// (theta / J)^(1/3), or 1 without a mean.
   mfem::real_t Stretch(int point) const;

   bool has_mean;
   std::vector<mfem::real_t> ratios;
   mfem::real_t volume = 0.0;
   mfem::real_t mean = 1.0;
};

} // namespace synovia
