#pragma once

#include "synovia/fem/nodal_recovery.hpp"
#include "synovia/materials/material_table.hpp"

namespace synovia
{

/// Continuous fields of finite deformation, as NodalRecovery makes them from
/// the logarithmic strain ln U, F = R U.
class DeformationRecovery
{
public:
   /// Borrows both. @a displacement has three components on H1 elements.
   DeformationRecovery(mfem::ParFiniteElementSpace &displacement,
                       const MaterialTable &materials);

   /// Recovers the fields anew; @a u is in the displacement's space.
   /// Collective.
   void Update(const mfem::ParGridFunction &u);

   /// Principal logarithmic strains, largest first.
   mfem::ParGridFunction &PrincipalStrain() { return principal; }
   /// J = det F = exp(tr ln U).
   mfem::ParGridFunction &VolumeRatio() { return volume_ratio; }
   /// 1 - phi_0/J with the referential solid fraction phi_0.
   mfem::ParGridFunction &Porosity() { return porosity; }

private:
   mfem::Vector SolidFractions(const MaterialTable &materials);

   NodalRecovery recovery;
   mfem::ParFiniteElementSpace vectors;
   mfem::ParFiniteElementSpace scalars;
   /// ln U: xx, yy, zz, xy, yz, xz.
   mfem::ParGridFunction strain;
   mfem::ParGridFunction principal;
   mfem::ParGridFunction volume_ratio;
   mfem::ParGridFunction porosity;
   /// Means over the elements around each node.
   mfem::Vector solid_fractions;
};

} // namespace synovia
