#pragma once

#include "synovia/fem/body_form.hpp"
#include "synovia/fem/smooth_stabilization.hpp"
#include "synovia/fem/spring_foundation.hpp"

#include <memory>
#include <vector>

namespace synovia
{

/// Bodies of infinitesimal strain and linear laws:
///
///     momentum:  K u - B^T p
///     mass:      B (u - u0) + dt (L p - s) + S (p - p0 - smooth part)
///
/// with matrices that never change, and s what vessels let in where the
/// pressure is 0.
class LinearBodyForm : public BodyForm
{
public:
   /// Assembles all matrices, with the springs' stiffness added to the bodies'.
   /// Borrows @a spaces.
   LinearBodyForm(BiphasicSpaces &spaces, const MaterialTable &materials,
                  const std::vector<SpringFoundation> &springs);

   void StartStage(const BodyStage &stage, const mfem::Vector &pressure_rate,
                   mfem::real_t rate_dt) override;
   void Mult(const BodyStage &stage, mfem::Vector &momentum,
             mfem::Vector &mass) const override;
   void MultFromStart(const BodyStage &stage, mfem::Vector &momentum,
                      mfem::Vector &mass) const override
   {
      Mult(stage, momentum, mass);
   }
   void GetGrowth(const BodyStage &stage, mfem::Vector &growth) const override;
   std::optional<mfem::real_t> Supply(const BodyStage &stage) const override;
   void AddMagnitudes(mfem::real_t dt, const mfem::Vector &u,
                      const mfem::Vector &p, mfem::Vector &momentum,
                      mfem::Vector &mass) const override;
   std::string Validate(const BodyStage &) const override { return ""; }
   bool IsLinear() const override { return true; }
   bool Linearize(const BodyStage &) override { return false; }
   const VolumeMatrices &Tangent() const override { return matrices; }

private:
   VolumeMatrices matrices;
   /// For order 1.
   std::unique_ptr<SmoothStabilization> smooth_stabilization;
   /// What the stabilization does to the smooth part of the pressure's change,
   /// which it must not do, in the stage (volume).
   mfem::Vector relief;
   bool has_supply = false;
   /// s, true dofs (volume / time), if there are vessels.
   mfem::Vector supply;
};

} // namespace synovia
