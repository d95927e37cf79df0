#pragma once

#include "synovia/materials/deformation.hpp"
#include "synovia/materials/material_table.hpp"

#include <map>

namespace synovia
{

/// Continuous stress fields by averaging over the elements around each node.
///
/// The stress of finite elements jumps between them. In each element it is
/// fitted, one order below the displacement, to its values at the quadrature
/// points where it is most accurate, and evaluated at the displacement's nodes;
/// nodes take the mean of the elements around them. Bodies that share no nodes
/// are not averaged with each other; materials within a body are.
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
   /// Principal total stresses, largest first; those of the effective stress
   /// are larger by p.
   mfem::ParGridFunction &Principal() { return principal; }

private:
   /// Quadrature points and the matrix (nodes x points) that takes stresses at
   /// them to those at the nodes of an element.
   struct Extrapolation
   {
      const mfem::IntegrationRule *rule;
      mfem::DenseMatrix to_nodes;
   };

   const Extrapolation &ExtrapolationOf(const mfem::FiniteElement &element);
   /// Sums over elements, in @a field, into means over them, on all ranks.
   void Average(mfem::ParGridFunction &field) const;

   /// Six components of the effective stress at a point.
   void GetStress(const SolidLaw &law, const MaterialPoint &point,
                  const mfem::DenseMatrix &gradient, mfem::Vector &stress);

   const MaterialTable &materials;
   Deformation deformation;
   mfem::DenseMatrix stiffness;
   mfem::Vector strain;
   mfem::ParFiniteElementSpace tensors;
   mfem::ParFiniteElementSpace vectors;
   mfem::ParGridFunction effective;
   mfem::ParGridFunction total;
   mfem::ParGridFunction principal;
   mfem::Vector elements_of_dof;
   std::map<mfem::Geometry::Type, Extrapolation> extrapolations;
};

} // namespace synovia
