#pragma once

#include "synovia/contact/contact_constraint.hpp"
#include "synovia/contact/contact_state.hpp"
#include "synovia/general/solver_tuning.hpp"

#include <memory>

namespace synovia
{

class ContactFriction;

/// Which vertices come into contact.
enum class TouchRule
{
   /// Those with a compressive traction.
   traction,
   /// Also those within the gap tolerance, and the nearest one if it is as near
   /// as that of round surfaces in contact at a point: a first guess, where no
   /// traction is known.
   nearness
};

/// What tractions and fluxes have of gaps and jumps besides the multipliers.
enum class ContactStiffness
{
   /// Nothing: tractions and fluxes are the multipliers.
   none,
   /// As much as the bodies resist.
   bodies,
   /// The penalties, a hundred times as much.
   penalty
};

/// How far the constraints of contact are violated, over all ranks.
struct ContactViolations
{
   /// Largest gap of a vertex in contact (length).
   mfem::real_t penetration = 0.0;
   /// Largest pressure jump of a vertex that exchanges fluid (stress).
   mfem::real_t pressure_jump = 0.0;
   /// Largest slip of a vertex that sticks, or error of one that slides, as its
   /// traction over the penalty (length).
   mfem::real_t slip = 0.0;
};

/// Change of the multipliers of each of this rank's vertices of the
/// destination.
struct MultiplierStep
{
   /// Stress.
   mfem::Vector traction;
   /// Length / time.
   mfem::Vector flux;
   /// Tangential (stress); empty without friction.
   VectorByComponent friction;
};

/// Enforces a constraint by penalties and multipliers: in contact the traction
/// is t = lambda + eta g, the flux q = mu + eta_p (p_A - p_B), and
/// augmentations take them into lambda and mu until gaps and jumps are within
/// tolerance. Decides which vertices are in contact.
///
/// Large because it has all steps of one algorithm, in the order in which a
/// stage takes them, and then those of a time step that accepts or rejects it.
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
   ~AugmentedLagrangian();
   /// There is friction from now on. Comes before any step.
   void AddFriction(std::unique_ptr<ContactFriction> friction_);

   /// Null where there is none.
   ContactFriction *Friction() { return friction.get(); }
   const ContactFriction *Friction() const { return friction.get(); }

   /// Vertices (multiplier true dofs, ascending) whose pressure boundary
   /// conditions hold: no fluid passes those of the destination, as no pressure
   /// of theirs could close the jump.
   void SetHeldPressures(const mfem::Array<int> &vertices);
   /// For steps of length @a dt (time); until then for steady flow.
   void SetTimeStep(mfem::real_t dt);
   /// To be called after each search of the constraint: penalties derive from
   /// what it found.
   void UpdatePenalties();

   /// Predicts the multipliers of a stage that ends at @a time.
   void StartStage(mfem::real_t time);
   /// Evaluates gaps and jumps at displacement @a u and pressure @a p (true
   /// dofs). Collective.
   void Evaluate(const mfem::Vector &u, const mfem::Vector &p);
   /// Decides from the gaps which vertices are in contact and which of them
   /// seal the surface. A vertex seals where the source covers it and the gap
   /// is within its tolerance: nothing drains through less, and if seals broke
   /// with each tensile vertex, Newton's method would not settle. As the
   /// fluid's pressure could open and close a seal again and again, each may
   /// break once in a stage. Trial tractions are those of @a stiffness, from a
   /// state that leaves a node out of balance by as much as @a imbalance
   /// (force). Collective; true if any rank's set changed, or is in doubt.
   bool UpdateActiveSet(TouchRule rule = TouchRule::traction,
                        ContactStiffness stiffness = ContactStiffness::penalty,
                        mfem::real_t imbalance = 0.0);
   /// Whether the last UpdateActiveSet() let vertices slide that stuck, or the
   /// other way, on any rank.
   bool SlidingChanged() const;
   /// Traction and flux from the last gaps, with the present active set.
   void UpdateTractions(ContactStiffness stiffness = ContactStiffness::penalty);
   /// The change of the multipliers in a Newton step with these changes of gaps
   /// and jumps: to traction and flux with penalties after the step in the
   /// active set, to zero elsewhere.
   MultiplierStep FindMultiplierStep(const mfem::Vector &gap_change,
                                     const mfem::Vector &jump_change) const;
   /// Adds what was solved for in the active set: area x traction (force), and
   /// area x flux (volume / time).
   void AddSolved(const mfem::Vector &forces, const mfem::Vector &outflows,
                  MultiplierStep &step) const;
   /// FindMultiplierStep() for friction, with a step of displacement and
   /// pressure (true dofs); empty without. Collective.
   VectorByComponent FindFrictionStep(const mfem::Vector &du,
                                      const mfem::Vector &dp) const;
   /// Adds a part of such a step.
   void AddToMultipliers(mfem::real_t share, const MultiplierStep &step);
   /// Collective.
   ContactViolations FindViolations() const;
   /// @a peak_pressure as found on all ranks (stress).
   bool IsWithinTolerance(const ContactViolations &violations,
                          mfem::real_t peak_pressure) const;
   /// lambda <- lambda + eta g, mu <- mu + eta_p (p_A - p_B). The next
   /// UpdateActiveSet() releases no vertex: corrections larger than the
   /// multipliers would release all of them at once.
   void Augment();
   /// To be called with each augmentation, before UpdateActiveSet(): raises the
   /// penalty of a violation that is out of tolerance and has hardly decreased
   /// since the last augmentation; true if it did. Penalties derived from the
   /// drained stiffness are too soft where a thin layer is loaded suddenly and
   /// holds its fluid.
   bool StiffenIfSlow(const ContactViolations &violations,
                      mfem::real_t peak_pressure);
   /// Stores traction and flux as the multipliers at @a time.
   void Store(mfem::real_t time);

   /// Forgets all times but the last one, for predictions.
   void ForgetPast() { state.history.ForgetPast(); }
   /// Accepts the state, and restores the one accepted last.
   void Accept();
   void Restore();
   /// Lists the accepted state; reading sets it. Collective.
   void Archive(StateArchive &archive, const std::string &prefix);

   const ContactState &State() const { return state; }
   const ContactPenalties &Penalties() const { return penalties; }
   /// Whether fluid passes from one surface to the other at a vertex.
   bool Exchanges(int vertex) const
   {
      return fluid == FluidSides::both && state.vertices[vertex].seals &&
             !pressure_held[vertex];
   }

private:
   /// Which displacement the next UpdateActiveSet() judges.
   enum class Phase
   {
      /// An extrapolated one.
      prediction,
      /// That of an iteration.
      iteration,
      /// The same, with multipliers that were just corrected.
      augmentation
   };

   mfem::real_t TouchingGap() const;
   /// Normal tractions and their stiffness (stress / length) of all vertices.
   mfem::Vector TrialTractions(ContactStiffness stiffness) const;
   mfem::Vector GapStiffnesses(ContactStiffness stiffness) const;
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
   FluidSides fluid;
   mfem::Array<bool> pressure_held;
   ContactPenalties penalties;
   std::unique_ptr<ContactFriction> friction;
   Phase phase = Phase::iteration;
   /// At the last augmentation of the stage.
   ContactViolations last;
   ContactState state;
   ContactState accepted;
};

} // namespace synovia
