#pragma once

#include "synovia/fem/displacement_gradient.hpp"
#include "synovia/general/point3.hpp"
#include "synovia/materials/deformation.hpp"

#include <array>
#include <string>
#include <vector>

namespace synovia
{

/// A value, and the region and the place, as meshed, where it is found.
struct StrainExtreme
{
   mfem::real_t value = 0.0;
   std::string region;
   Point3 place{{0.0, 0.0, 0.0}};
};

/// How far all bodies are deformed.
struct StrainExtremes
{
   /// The principal strain of the largest magnitude, tension positive: an
   /// eigenvalue of the symmetric part of grad u, or the logarithm of a
   /// principal stretch in finite deformation.
   StrainExtreme max_principal;
   /// The smallest det(I + grad u): the volume as a part of what it was; not
   /// positive where the displacement turns the material inside out.
   StrainExtreme min_det_F;
};

/// Finds the largest strains of a displacement, at the points of
/// DisplacementGradient.
///
/// A convex function, as the magnitude of the principal strain is, of a strain
/// that is linear along each edge has its maximum at a corner: for order 1 on
/// parallelepipeds, and up to order 2 on straight tetrahedra, the maximum over
/// the corners is the maximum over all points.
///
/// Values that differ by a millionth count as equal: the place is given in the
/// first of their elements in the mesh before distribution, so that it is the
/// same on any number of ranks.
class StrainMonitor
{
public:
   /// Borrows both. @a displacement has three components. Regions that are
   /// @a rigid, by their attributes, are left out: where they turn, elements of
   /// order 1 bend.
   StrainMonitor(NamedMesh &mesh, const mfem::ParGridFunction &displacement,
                 Deformation deformation = Deformation::infinitesimal,
                 const mfem::Array<int> &rigid = mfem::Array<int>());

   /// Of the displacement as it is now. Collective.
   StrainExtremes Measure();

private:
   /// Two numbers whose maxima are sought: the magnitude of the principal
   /// strain, and 1 - det F.
   enum Kind
   {
      strain,
      volume_loss
   };
   using Severity = std::array<mfem::real_t, 2>;

   /// Sets the severities, but leaves out strains that are not the largest of
   /// this rank.
   void MeasureElements();
   /// The principal strain of the largest magnitude, to all digits.
   mfem::real_t PrincipalStrain(const mfem::DenseMatrix &gradient) const;
   /// Where the severity of one kind first reaches @a least. Collective.
   StrainExtreme Locate(Kind kind, mfem::real_t least);

   const NamedMesh &mesh;
   Deformation deformation;
   mfem::Array<int> rigid;
   DisplacementGradient gradients;
   /// Of each element of this rank.
   std::vector<Severity> severities;
};

} // namespace synovia
