#pragma once

#include "synovia/contact/contact_constraint.hpp"
#include "synovia/contact/contact_state.hpp"
#include "synovia/general/solver_tuning.hpp"

namespace synovia
{

/// What decides which vertices touch, where nothing was decided before.
enum class TouchRule
{
   /// The traction is compressive.
   traction,
   /// Or the vertex is within the gap tolerance, or it is the nearest one and
   /// as near as round surfaces in contact at a point are: a guess to start
   /// from where nothing is known of the traction.
   nearness
};

/// What gaps and jumps count beside the multipliers in tractions and fluxes.
enum class ContactStiffness
{
   /// Nothing: tractions and fluxes are the multipliers.
   none,
   /// As much as the bodies resist.
   bodies,
   /// The penalties, a hundred times as much.
   penalty
};

/// What augmentations have to make small, over all ranks.
struct ContactViolations
{
   /// Largest gap of what touches (length).
   mfem::real_t penetration = 0.0;
   /// Largest jump of what exchanges fluid (stress).
   mfem::real_t pressure_jump = 0.0;
};

/// Change of the multipliers of each of this rank's vertices of the
/// destination.
struct MultiplierStep
{
   /// Stress.
   mfem::Vector traction;
   /// Length / time.
   mfem::Vector flux;
};

/// Enforces a constraint by penalties and multipliers: in contact the traction
/// is t = lambda + eta g, the flux q = mu + eta_p (p_A - p_B), and
/// augmentations take them into lambda and mu until gaps and jumps are within
/// tolerance. Decides which vertices are in contact.
///
/// Large because it has all steps of one algorithm, in the order in which a
/// stage takes them, and then what a time step does with the result.
class AugmentedLagrangian
{
public:
   /// Borrows @a constraint. @a vertex_areas are the whole areas of the
   /// @a destination's vertices; borrowed as well.
   AugmentedLagrangian(ContactConstraint &constraint,
                       const ContactSurface &destination,
                       const mfem::Vector &vertex_areas,
                       const ContactScales &scales,
                       const ContactOptions &options,
                       const ContactTuning &tuning = ContactTuning());

   /// Vertices (multiplier true dofs, ascending) whose pressure boundary
   /// conditions hold: no fluid passes those of the destination, as no pressure
   /// of theirs could close the jump.
   void SetHeldPressures(const mfem::Array<int> &vertices);
   /// For steps of length @a dt (time); until then for steady flow.
   void SetTimeStep(mfem::real_t dt);
   /// To be called whenever the constraint searched; before that there is
   /// nothing to derive penalties from.
   void UpdatePenalties();

   /// Predicts the multipliers of a stage that ends at @a time.
   void StartStage(mfem::real_t time);
   /// Takes gaps and jumps at displacement @a u and pressure @a p (true dofs).
   /// Collective.
   void Evaluate(const mfem::Vector &u, const mfem::Vector &p);
   /// Decides from the gaps which vertices are in contact and which of them
   /// seal the surface. A vertex seals where the source covers it and no more
   /// than the gap tolerance is open: nothing drains through less, and a seal
   /// that broke with every tensile vertex would not let Newton's method
   /// settle. Nor would one that breaks and closes with the fluid's pressure
   /// again and again: in a stage each may break once. Collective; true if any
   /// rank's set changed. Trial tractions are those of @a stiffness.
   bool UpdateActiveSet(TouchRule rule = TouchRule::traction,
                        ContactStiffness stiffness = ContactStiffness::penalty);
   /// Traction and flux from the last gaps, of the active set as it is.
   void UpdateTractions(ContactStiffness stiffness = ContactStiffness::penalty);
   /// How multipliers change by a Newton step that changes gaps and jumps like
   /// this: to what bears, or exchanges, with penalties after the step, else to
   /// zero.
   MultiplierStep FindMultiplierStep(const mfem::Vector &gap_change,
                                     const mfem::Vector &jump_change) const;
   /// Adds a part of it.
   void AddToMultipliers(mfem::real_t share, const MultiplierStep &step);
   /// Collective.
   ContactViolations FindViolations() const;
   /// @a peak_pressure as found on all ranks (stress).
   bool IsWithinTolerance(const ContactViolations &violations,
                          mfem::real_t peak_pressure) const;
   /// lambda <- lambda + eta g, mu <- mu + eta_p (p_A - p_B). The next
   /// UpdateActiveSet() releases nothing: a multiplier that is corrected by
   /// more than itself would else let go of all at once.
   void Augment();
   /// To be called with each augmentation, before UpdateActiveSet(): raises the
   /// penalty of what is out of tolerance and has hardly become smaller since
   /// the last one. Penalties derived from the drained stiffness are too soft
   /// where a thin layer is loaded at once, and holds its fluid. Says whether
   /// it did.
   bool StiffenIfSlow(const ContactViolations &violations,
                      mfem::real_t peak_pressure);
   /// Keeps traction and flux as the multipliers reached at @a time.
   void Store(mfem::real_t time);

   /// Leaves one time to predict from.
   void ForgetPast() { state.history.ForgetPast(); }
   /// Remembers the state, and goes back to what was remembered.
   void Accept();
   void Restore();
   /// Lists what was remembered; reading sets it. Collective.
   void Archive(StateArchive &archive, const std::string &prefix);

   const ContactState &State() const { return state; }
   const ContactPenalties &Penalties() const { return penalties; }
   /// Whether fluid passes from one surface to the other at a vertex.
   bool Exchanges(int vertex) const
   {
      return state.vertices[vertex].seals && !pressure_held[vertex];
   }

private:
   /// What gaps are compared with the multipliers next.
   enum class Phase
   {
      /// Those of an extrapolated displacement.
      prediction,
      iteration,
      /// The multipliers were just corrected.
      augmentation
   };

   mfem::real_t TouchingGap() const;
   /// Of a vertex (stress / length).
   mfem::real_t GapStiffness(int vertex, ContactStiffness stiffness) const;
   /// Of a vertex (length / time / stress).
   mfem::real_t JumpStiffness(int vertex, ContactStiffness stiffness) const;
   void TakeMultipliers();

   ContactConstraint &constraint;
   const ContactSurface &destination;
   const mfem::Vector &vertex_areas;
   ContactOptions options;
   ContactTuning tuning;
   mfem::real_t gap_tolerance;
   mfem::Array<bool> pressure_held;
   ContactPenalties penalties;
   Phase phase = Phase::iteration;
   /// At the last augmentation of the stage.
   ContactViolations last;
   ContactState state;
   ContactState accepted;
};

} // namespace synovia
