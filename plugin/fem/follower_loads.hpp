#pragma once

#include "synovia/fem/assembled_matrix.hpp"
#include "synovia/fem/biphasic_spaces.hpp"
#include "synovia/general/load_curve.hpp"

#include <vector>

namespace synovia
{

/// Loads on boundaries that deform: tractions t along the current outward
/// normal and outflow Q through the current area,
///
///     int t n.w da = int t (x_,1 x x_,2).w,    -int Q q da,
///
/// x_,1 and x_,2 being tangents of the deformed boundary. Their derivatives by
/// the displacement, and by the pressure of those that depend on it, are
/// complete, and not symmetric.
class FollowerLoads
{
public:
   /// Borrows @a spaces.
   explicit FollowerLoads(BiphasicSpaces &spaces);

   /// Total traction along the normal (stress; tension is positive) on the
   /// boundaries of a @a marker.
   void AddTraction(const mfem::Array<int> &marker, const LoadCurve &value);
   /// Traction of the solid alone, to which the fluid's pressure p adds: the
   /// total one is @a value - p.
   void AddEffectiveTraction(const mfem::Array<int> &marker,
                             const LoadCurve &value);
   /// Outward relative flux (length / time).
   void AddFlux(const mfem::Array<int> &marker, const LoadCurve &value);

   /// Outward flux of fluid and solid together (length / time): the relative
   /// one is less by the solid's velocity along the normal.
   void AddMixtureFlux(const mfem::Array<int> &marker, const LoadCurve &value);

   bool Any() const
   {
      return !tractions.empty() || !effective_tractions.empty() ||
             !fluxes.empty() || !mixture_fluxes.empty();
   }

   /// The state of a body, local dofs: time, length of the stage, displacement
   /// at its end and at its beginning, and pressure.
   struct State
   {
      mfem::real_t t;
      mfem::real_t dt;
      const mfem::Vector &u;
      const mfem::Vector &u0;
      const mfem::Vector &p;
   };

   /// Adds the loads: forces, and the volume / time of fluid that they let in.
   void AddLoads(const State &state, mfem::Vector &forces,
                 mfem::Vector &inflow) const;

   /// Subtracts their derivatives by the displacement: the forces' from
   /// @a stiffness, and dt x the inflow's from @a flow_change,
   /// pressure x displacement. Adds the derivative of the forces by the
   /// pressure to @a coupling, displacement x pressure.
   void AddDerivatives(const State &state, AssembledMatrix &stiffness,
                       AssembledMatrix &coupling,
                       AssembledMatrix &flow_change) const;

private:
   struct Load
   {
      mfem::Array<int> marker;
      LoadCurve value;
   };

   /// Calls work(face, value) for each face of each of the loads.
   template <typename Work>
   void ForEachLoad(const std::vector<Load> &loads, const State &state,
                    const Work &work) const;

   BiphasicSpaces &spaces;
   std::vector<Load> tractions;
   std::vector<Load> effective_tractions;
   std::vector<Load> fluxes;
   std::vector<Load> mixture_fluxes;
};

} // namespace synovia
