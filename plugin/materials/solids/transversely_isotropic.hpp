#pragma once

#include "synovia/materials/law_arguments.hpp"
#include "synovia/materials/law_description.hpp"
#include "synovia/materials/linear_solid.hpp"
#include "synovia/materials/material_frame.hpp"

#include <algorithm>
#include <string>

namespace synovia
{

/// Constants of a solid with fibers along theta, alike in all directions across
/// them: E_z = E_r, nu_ztheta = nu_rtheta, G_ztheta = G_rtheta and
/// G_rz = E_r / (2 (1 + nu_rz)).
///
/// nu_ij is the contraction along j under tension along i, so that
/// nu_ij / E_i = nu_ji / E_j.
struct FiberConstants
{
   /// Young's moduli across and along the fibers (stress).
   mfem::real_t young_r = 0.0;
   mfem::real_t young_theta = 0.0;
   mfem::real_t poisson_rtheta = 0.0;
   mfem::real_t poisson_rz = 0.0;
   /// Shear modulus along the fibers (stress).
   mfem::real_t shear_rtheta = 0.0;
};

/// Transversely isotropic linear elasticity, uniform in its frame: fibers.
class TransverselyIsotropic : public LinearSolid
{
public:
   static LawDescription Describe();

   explicit TransverselyIsotropic(const LawArguments &from);
   /// Borrows @a frame. Throws Error if a modulus is not positive, or if the
   /// stiffness is not positive definite.
   TransverselyIsotropic(const FiberConstants &constants,
                         const MaterialFrame &frame);

   void GetStiffness(mfem::ElementTransformation &trans,
                     const mfem::IntegrationPoint &ip,
                     mfem::DenseMatrix &stiffness) const override;
   std::string Validate(mfem::ElementTransformation &trans) const override
   {
      return frame.Validate(trans);
   }
   /// Across the fibers.
   mfem::real_t AggregateModulus() const override { return local(0, 0); }
   /// The smaller one.
   mfem::real_t ShearModulus() const override
   {
      return std::min(local(3, 3), local(5, 5));
   }

private:
   const MaterialFrame &frame;
   /// Stiffness in the frame's axes.
   mfem::DenseMatrix local;
};

} // namespace synovia
