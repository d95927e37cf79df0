#pragma once

#include "synovia/fem/nodal_recovery.hpp"
#include "synovia/materials/deformation.hpp"
#include "synovia/materials/material_table.hpp"

namespace synovia
{

/// Continuous stress fields, as NodalRecovery makes them.
///
/// Six components, in the order xx, yy, zz, xy, yz, xz; tension is positive.
class StressRecovery
{
public:
   /// Borrows both. @a displacement has three components on H1 elements.
   StressRecovery(mfem::ParFiniteElementSpace &displacement,
                  const MaterialTable &materials,
                  Deformation deformation = Deformation::infinitesimal);

   /// Recovers the fields anew. @a u is in the displacement's space, @a p is a
   /// scalar field on the same mesh. Collective.
   void Update(const mfem::ParGridFunction &u, const mfem::ParGridFunction &p);

   /// sigma_E = C eps(u), or Cauchy's effective stress in finite deformation.
   mfem::ParGridFunction &Effective() { return effective; }
   /// sigma_T = sigma_E - p I.
   mfem::ParGridFunction &Total() { return total; }
   /// Principal total stresses, largest first; the principal effective stresses
   /// are larger by p.
   mfem::ParGridFunction &Principal() { return principal; }

   /// For fields of directions.
   mfem::ParFiniteElementSpace &VectorSpace() { return vectors; }
   /// Sets unit vectors along which the principal stress is largest and
   /// smallest, in the VectorSpace().
   void GetDirections(mfem::ParGridFunction &largest,
                      mfem::ParGridFunction &smallest) const;

private:
   /// Six components of the effective stress at a point.
   void GetStress(const SolidLaw &law, const MaterialPoint &point,
                  const mfem::DenseMatrix &gradient, mfem::Vector &stress);
   mfem::DenseMatrix TotalAt(int node) const;

   const MaterialTable &materials;
   Deformation deformation;
   mfem::DenseMatrix stiffness;
   mfem::Vector strain;
   NodalRecovery recovery;
   mfem::ParFiniteElementSpace &tensors;
   mfem::ParFiniteElementSpace vectors;
   mfem::ParGridFunction effective;
   mfem::ParGridFunction total;
   mfem::ParGridFunction principal;
};

} // namespace synovia
