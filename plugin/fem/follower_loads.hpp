#pragma once

#include "synovia/fem/biphasic_spaces.hpp"
#include "synovia/fem/local_matrix.hpp"
#include "synovia/general/load_curve.hpp"

#include <vector>

namespace synovia
{

/// Loads on boundaries that deform: tractions t along the current outward
/// normal and outflow Q through the current area,
///
///     int t n.w da = int t (x_,1 x x_,2).w,    -int Q q da,
///
/// x_,1 and x_,2 being tangents of the deformed boundary. Their derivative by
/// the displacement is complete, and not symmetric.
class FollowerLoads
{
public:
   /// Borrows @a spaces.
   explicit FollowerLoads(BiphasicSpaces &spaces);

   /// Total traction along the normal (stress; tension is positive) on the
   /// boundaries of a @a marker.
   void AddTraction(const mfem::Array<int> &marker, const LoadCurve &value);
   /// Outward relative flux (length / time).
   void AddFlux(const mfem::Array<int> &marker, const LoadCurve &value);

   bool Any() const { return !tractions.empty() || !fluxes.empty(); }

   /// Adds the loads at time @a t of the body displaced by @a u: forces, and
   /// the volume / time of fluid that they let in. All local dofs.
   void AddLoads(mfem::real_t t, const mfem::Vector &u, mfem::Vector &forces,
                 mfem::Vector &inflow) const;

   /// Subtracts their derivatives by the displacement: that of the forces from
   /// @a stiffness, and @a dt x that of the inflow from @a flow_change,
   /// pressure x displacement.
   void SubtractDerivatives(mfem::real_t t, mfem::real_t dt,
                            const mfem::Vector &u, LocalMatrix &stiffness,
                            LocalMatrix &flow_change) const;

private:
   struct Load
   {
      mfem::Array<int> marker;
      LoadCurve value;
   };

   BiphasicSpaces &spaces;
   std::vector<Load> tractions;
   std::vector<Load> fluxes;
};

} // namespace synovia
