#pragma once

#include "synovia/contact/contact_state.hpp"
#include "synovia/contact/finite_constraint.hpp"
#include "synovia/contact/friction_law.hpp"
#include "synovia/contact/tangential_turn.hpp"

namespace synovia
{

/// Friction between the surfaces of a pair in finite deformation: what sticks
/// and what slides, the tangential tractions, and their derivatives.
///
/// The slip of a step is that of the points that faced each other at its
/// beginning (origin), a linear function of the displacement until the step
/// ends, seen across the present normal n_j of a vertex:
///
///     s_j = (I - n_j n_j^T) d_j - Q (the same at the origin)
///
/// with the d_j of SlidingMaps, and Q the turn of the normal since then: a
/// motion of both surfaces together is no slip. Where no point around a vertex
/// faced the other surface then, the slip is that of the points that do now.
/// With a multiplier Lambda_j and the penalty eps,
///
///     trial_j = Q Lambda_j + eps s_j,
///     t_j = trial_j where a vertex sticks, limit_j trial_j / |trial_j| where
///     it
///           slides,
///
/// with the limit of FrictionLaw; a vertex sticks while the trial is within the
/// limit. The multipliers follow as those of the gap do, until nothing slips
/// where it sticks, and tractions are along the slip where it slides.
///
/// Members that take a ContactState read its normal tractions and active set,
/// and work on its FrictionState. All are collective, but where noted.
///
/// Large because it has all steps of a stage, as AugmentedLagrangian does.
class ContactFriction
{
public:
   /// Borrows @a constraint and @a destination.
   ContactFriction(FiniteConstraint &constraint,
                   const ContactSurface &destination, const FrictionLaw &law);

   const FrictionLaw &Law() const { return law; }

   /// Lets the surfaces look for each other where the last step ended, unless
   /// they did: the origin of slips.
   void FindOrigin();
   /// Takes the displacement of the last Evaluate() as the end of a step; not
   /// collective.
   void Accept(ContactState &state);
   /// Takes @a u (true dofs) as that; not collective.
   void SetOrigin(const mfem::Vector &u);
   void Archive(StateArchive &archive, const std::string &prefix);

   /// To be called with each new stage; not collective.
   void StartStage(FrictionState &state);
   /// Evaluates slips and normals at displacement @a u and pressure @a p, where
   /// the constraint was evaluated; does nothing before FindOrigin().
   void Evaluate(const mfem::Vector &u, const mfem::Vector &p,
                 FrictionState &state);
   /// Decides where limits are those of these @a normal tractions until the
   /// next decision, as tractions with penalties (@a pressing) are far from
   /// them: their derivatives would lead astray. Not collective.
   void LagLimits(const mfem::Vector &normal, const mfem::Vector &pressing,
                  ContactState &state);
   /// Decides of what comes into contact whether it slides at the first guess
   /// of a stage, as UpdateSliding() does; all else stays, as a predicted slip
   /// is no better than a predicted gap. Not collective.
   void PredictSliding(const mfem::Vector &normal,
                       const std::vector<VertexContact> &before,
                       const mfem::Vector &stiffness, ContactState &state);
   /// Decides what slides under these @a normal tractions, with trials of this
   /// @a stiffness (stress / length); says whether anything changed on any
   /// rank, or waits. What sticks waits for the second decision of a stage
   /// where its trial exceeds the limit by little beside the largest
   /// @a imbalance of a node (force).
   bool UpdateSliding(const mfem::Vector &normal,
                      const std::vector<VertexContact> &before,
                      const mfem::Vector &stiffness,
                      const mfem::Vector &penalty, mfem::real_t imbalance,
                      ContactState &state);
   /// Whether anything changed the last time; not collective.
   bool SlidingChanged() const { return sliding_changed; }
   /// Sets the tractions, with trials of this @a stiffness (stress / length).
   /// Not collective.
   void UpdateTractions(const mfem::Vector &stiffness,
                        const mfem::Vector &penalty, ContactState &state) const;
   /// The multipliers are those that give the tractions; not collective.
   void TakeMultipliers(FrictionState &state) const;

   /// D of SlidingMaps, at the last Evaluate().
   const MatrixByComponent &Distance() const { return present.distance; }
   /// Adds nodal forces of the last tractions, with the @a area of vertices.
   void AddForces(const FrictionState &state, const mfem::Vector &area,
                  mfem::Vector &momentum) const;

   /// Sets the derivatives for the last tractions, of normal and tangential
   /// directions, and for pressures @a p (true dofs). The constraint was
   /// linearized, @a gaps are its factors with weights.
   /// @a area_resistance: area x what bodies resist (force / length).
   void Linearize(const mfem::Vector &p, const ContactFactors &gaps,
                  const mfem::Vector &area, const mfem::Vector &penalty,
                  const mfem::Vector &area_resistance,
                  const ContactState &state);
   /// They are those of other points: there are none until the next
   /// Linearize(); not collective.
   void ForgetDerivatives() { force_change.reset(); }
   /// As ContactFactors has them, with what the constraint has; null if there
   /// are none.
   const mfem::HypreParMatrix *ForceChange() const
   {
      return force_change.get();
   }
   const mfem::HypreParMatrix *SoftForceChange() const
   {
      return force_change ? soft_force_change.get() : nullptr;
   }
   const mfem::HypreParMatrix *ForceByPressure() const
   {
      return force_change ? force_by_pressure.get() : nullptr;
   }

   /// How the multipliers change in a Newton step: to the tractions after it.
   /// @a normal: tractions with penalties.
   VectorByComponent FindMultiplierStep(const mfem::Vector &du,
                                        const mfem::Vector &dp,
                                        const mfem::Vector &normal,
                                        const mfem::Vector &penalty,
                                        const ContactState &state) const;
   /// Largest slip, or error of what slides, that multipliers don't account
   /// for, on this rank (length). Not collective.
   mfem::real_t FindViolation(const mfem::Vector &normal,
                              const mfem::Vector &penalty,
                              const ContactState &state) const;

private:
   /// What tractions depend on at a vertex.
   struct Response
   {
      bool sticks = false;
      Point3 traction{{0.0, 0.0, 0.0}};
      /// By the trial traction, and by the limit.
      Matrix3 by_trial{};
      Point3 by_limit{{0.0, 0.0, 0.0}};
   };

   /// Whether any point around a vertex faced the source at the origin.
   bool HasOrigin(int vertex) const
   {
      return Length(FrictionState::At(origin_normal, vertex)) > 0.5;
   }
   TangentialTurn Turn(const FrictionState &state, int vertex) const
   {
      return {FrictionState::At(origin_normal, vertex),
              FrictionState::At(state.normal, vertex)};
   }
   /// Multiplier less what the penalty would make of the origin, across the
   /// normal there.
   Point3 Carried(const FrictionState &state, int vertex,
                  mfem::real_t stiffness) const;
   Point3 Trial(const FrictionState &state, int vertex,
                mfem::real_t stiffness) const;
   /// Under a normal traction, with a trial of this stiffness.
   Response Respond(const FrictionState &state, int vertex, mfem::real_t normal,
                    mfem::real_t stiffness, mfem::real_t penalty) const;

   FiniteConstraint &constraint;
   const ContactSurface &destination;
   FrictionLaw law;
   /// Where the last step ended, and the last Evaluate() (true dofs).
   mfem::Vector accepted_at;
   mfem::Vector evaluated_at;
   /// Whether the origin is where the last step ended.
   bool origin_found = false;
   SlidingMaps origin;
   VectorByComponent origin_normal;
   SlidingMaps present;
   /// Of the tractions, by component.
   MatrixByComponent by_displacement;
   MatrixByComponent by_pressure;
   std::unique_ptr<mfem::HypreParMatrix> force_change;
   std::unique_ptr<mfem::HypreParMatrix> soft_force_change;
   std::unique_ptr<mfem::HypreParMatrix> force_by_pressure;
   bool sliding_changed = false;
   /// Whether UpdateSliding() has decided in this stage.
   bool decided = false;
   /// Of tractions at the last LagLimits() (stress).
   mfem::Vector lagged_limit;
   /// Tractions of the last Linearize() in this stage, if there was one, and
   /// where they were of what slides.
   bool linearized = false;
   VectorByComponent linearized_traction;
   std::vector<bool> slid_when_linearized;
};

} // namespace synovia
