#pragma once

#include "synovia/materials/solid_law.hpp"
#include "synovia/materials/tensor3.hpp"

namespace synovia
{

/// A point of an undeformed body; borrows.
struct MaterialPoint
{
   /// Set to @a ip.
   mfem::ElementTransformation &trans;
   const mfem::IntegrationPoint &ip;
};

/// Law of the drained solid in finite deformation: the first Piola-Kirchhoff
/// stress P (force per undeformed area) as a function of the deformation
/// gradient F = I + grad u.
///
/// Derive from DifferentiatedSolid to write the stress only.
class HyperelasticLaw : public SolidLaw
{
public:
   /// Sets the effective stress P_e and, unless @a tangent is null, dP_e/dF.
   /// False where the law has no value, as porous solids whose pores are
   /// closed; det F > 0 is the caller's to verify.
   virtual bool GetStress(const MaterialPoint &point, const Tensor3<> &F,
                          Tensor3<> &stress, Tangent3 *tangent) const = 0;

   /// That of small strains: the tangent at F = I.
   void GetStiffness(mfem::ElementTransformation &trans,
                     const mfem::IntegrationPoint &ip,
                     mfem::DenseMatrix &stiffness) const override;
};

} // namespace synovia
