#pragma once

#include "synovia/materials/solid_law.hpp"

namespace synovia
{

/// A solid of infinitesimal deformation: sigma_E = C eps, where derived classes
/// have the stiffness C.
class LinearSolid : public SolidLaw
{
public:
   /// C eps with eps the symmetric part of @a F - I.
   bool GetStress(const MaterialPoint &point, const Tensor3<> &F,
                  Tensor3<> &stress, Tangent3 *tangent) const override;
   /// A rotation of the body strains it.
   bool IsObjective() const override { return false; }
   void GetStiffness(mfem::ElementTransformation &trans,
                     const mfem::IntegrationPoint &ip,
                     mfem::DenseMatrix &stiffness) const override = 0;
};

} // namespace synovia
