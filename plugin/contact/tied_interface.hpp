#pragma once

#include "synovia/contact/augmented_lagrangian.hpp"
#include "synovia/contact/contact_factors.hpp"
#include "synovia/contact/tie_operators.hpp"
#include "synovia/contact/tie_scales.hpp"
#include "synovia/contact/tie_state.hpp"

#include <array>
#include <string>

namespace synovia
{

/// How far the constraints of a tie are violated, over all ranks.
struct TieViolations
{
   /// Largest jump of the displacement, by component (length), and of the
   /// pressure (stress).
   mfem::real_t displacement = 0.0;
   mfem::real_t pressure = 0.0;
};

/// Two surfaces of different bodies that are glued: displacement and fluid
/// pressure are continuous across them, though their meshes don't match. Where
/// one side has no fluid, the other is sealed.
///
/// The jumps of TieOperators are linear in the fields and known once for all;
/// multipliers and penalties close them, with t = lambda + eta [u] and q = mu +
/// eta_p [p], as AugmentedLagrangian does it for what touches. Points that are
/// apart as meshed stay so: it is the displacements that are alike. Tractions
/// and fluxes are per undeformed area of the destination.
///
/// Large because it has all steps of a stage, and then those of a time step.
class TiedInterface
{
public:
   /// Collective. Borrows @a spaces. Throws Error if the sides share a vertex,
   /// if one has no faces or is rigid, or on options out of range.
   TiedInterface(const std::string &name, BiphasicSpaces &spaces,
                 const MaterialTable &materials,
                 const mfem::Array<int> &source_boundary,
                 const mfem::Array<int> &destination_boundary,
                 const TieOptions &options,
                 const ContactTuning &tuning = ContactTuning());

   /// Lets the undeformed surfaces look for each other, for nodes that are held
   /// like this. Comes before all that follow. Collective. Throws Error if none
   /// is within the search radius.
   void Search(const TieHolds &holds);

   const std::string &Name() const { return name; }
   const TieScales &Scales() const { return scales; }
   const ContactSurface &Source() const { return source; }
   const ContactSurface &Destination() const { return destination; }
   const TieOperators &Operators() const { return operators; }
   const TieState &State() const { return state; }

   /// For steps of length @a dt (time); until then for steady flow.
   void SetTimeStep(mfem::real_t dt);
   /// Predicts the multipliers of a stage that ends at @a time.
   void StartStage(mfem::real_t time);
   /// Evaluates the jumps at @a u and @a p (true dofs). Collective.
   void Evaluate(const mfem::Vector &u, const mfem::Vector &p);
   /// Tractions and fluxes from the last jumps.
   void UpdateTractions(ContactStiffness stiffness = ContactStiffness::penalty);
   /// How the multipliers change by a Newton step of displacement and pressure
   /// (true dofs): to what penalties make of the jumps after it. Collective.
   TieMultipliers FindMultiplierStep(const mfem::Vector &du,
                                     const mfem::Vector &dp) const;
   void AddToMultipliers(mfem::real_t share, const TieMultipliers &step)
   {
      state.multiplier.Add(share, step);
   }
   /// Collective.
   TieViolations FindViolations() const;
   /// @a peak_pressure as found on all ranks (stress).
   bool IsWithinTolerance(const TieViolations &violations,
                          mfem::real_t peak_pressure) const;
   /// Takes tractions and fluxes over as multipliers.
   void Augment() { state.multiplier = state.acting; }
   /// As AugmentedLagrangian has it.
   bool StiffenIfSlow(const TieViolations &violations,
                      mfem::real_t peak_pressure);
   /// Stores traction and flux as the multipliers at @a time.
   void Store(mfem::real_t time) { state.Store(time); }

   /// Forgets all times but the last one, for predictions.
   void ForgetPast() { state.times[0] = state.times[1]; }
   /// Accepts the state, and restores the one accepted last.
   void Accept() { accepted = state; }
   void Restore();
   /// Lists the accepted state; reading sets it. Collective.
   void Archive(StateArchive &archive);

   /// Adds the nodal forces to @a momentum (force), and the fluid that leaves
   /// the nodes to @a mass (volume / time). Collective.
   void AddForces(mfem::Vector &momentum, mfem::Vector &mass) const;
   /// Of vectors of absolute values: what round-off is relative to. Collective.
   void AddMagnitudes(const mfem::Vector &u, const mfem::Vector &p,
                      mfem::Vector &momentum, mfem::Vector &mass) const;
   /// Of the linearized equations, an entry for each component.
   std::array<ContactFactors, 3> Factors() const;

private:
   void UpdatePenalties();
   mfem::real_t PressureTolerance(mfem::real_t peak_pressure) const;

   std::string name;
   BiphasicSpaces &spaces;
   TieScales scales;
   ContactTuning tuning;
   mfem::real_t pressure_tolerance;
   ContactSurface source;
   ContactSurface destination;
   mfem::Vector destination_areas;
   TieOperators operators;
   mfem::real_t time_step;
   /// What the bodies resist at a vertex (stress / length, and length / time /
   /// stress), and the penalties.
   mfem::Vector resistance;
   mfem::Vector conductance;
   mfem::Vector penalty;
   mfem::Vector pressure_penalty;
   /// Area x resistance, area x penalty, and zeros.
   VectorByComponent resistance_weights;
   VectorByComponent weights;
   mfem::Vector pressure_weights;
   mfem::Vector no_weights;
   TieState state;
   TieState accepted;
   /// At the last augmentation of the stage.
   TieViolations last;
};

} // namespace synovia
