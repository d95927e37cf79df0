#pragma once

#include "synovia/linalg/biphasic_linear_solver.hpp"
#include "synovia/physics/pushed_bodies.hpp"
#include "synovia/physics/solve_record.hpp"
#include "synovia/physics/stage_equations.hpp"

#include <string>
#include <vector>

namespace synovia
{

/// The contact of all pairs as a stage is solved: which points face each
/// other, which vertices touch, and what gaps are left; and the ties, of which
/// the same is asked. All members are collective.
class StageContact
{
public:
   /// Gaps and pressure jumps of all pairs.
   struct Violations
   {
      /// In the order of the pairs.
      std::vector<ContactViolations> pairs;
      /// In the order of the interfaces.
      std::vector<TieViolations> interfaces;
      /// Largest pressure (stress).
      mfem::real_t peak_pressure = 0.0;
      bool within_tolerance = true;
   };

   /// Borrows all arguments. @a linear learns of new searches, @a record counts
   /// them.
   StageContact(MPI_Comm comm, const std::vector<ContactPair *> &pairs,
                const std::vector<TiedInterface *> &interfaces,
                const std::vector<PushedBodies> &pushed,
                StageEquations &equations, BiphasicLinearSolver &linear,
                SolveRecord &record);

   /// Searches, and decides by @a rule what touches at the first guess of the
   /// stage. One of nonlinear bodies in which surfaces overlap is taken back:
   /// what a force presses is slowed down by what resists it.
   void Start(ImplicitStage &stage, TouchRule rule);
   /// The part of a step after which no surfaces overlap by more than a small
   /// part of the size of their faces that didn't before.
   mfem::real_t ShareBeforeOverlap(const mfem::Vector &displacement) const;
   /// Decides anew what touches, from the gaps as they were evaluated last and
   /// trial tractions of @a stiffness, where a node may be out of balance by
   /// @a imbalance (force); says whether anything changed, or is in doubt.
   bool Update(ImplicitStage &stage, ContactStiffness stiffness,
               mfem::real_t imbalance = 0.0);
   /// Lets pairs search anew whose points have gone to other partners, and
   /// updates them; says whether any did. Pairs that keep what former steps
   /// have found look only where the active set has @a settled.
   bool SearchDrifted(ImplicitStage &stage, ContactStiffness stiffness,
                      bool settled);
   /// Remembers what surfaces hit as they were evaluated last, for GoBack().
   void Remember();
   /// Lets them hit that again, once trial states have been evaluated; the
   /// contact must be evaluated next.
   void GoBack();
   /// Whether vertices of a pair began or ceased to slide at its last update.
   bool SlidingChanged() const;
   /// Whether there is friction in any of the pairs.
   bool HasFriction() const;
   Violations FindViolations(const ImplicitStage &stage) const;

   /// Takes the tractions over as multipliers, and raises penalties that are
   /// too soft; says whether it raised any.
   bool Augment(const Violations &violations);
   /// Raises the penalties of what is out of tolerance and has hardly become
   /// smaller since the last time; says whether it raised any.
   bool StiffenIfSlow(const Violations &violations);
   /// Takes tractions and fluxes from the gaps as they were evaluated last.
   void SetTractions(ContactStiffness stiffness);

   const std::vector<ContactPair *> &Pairs() const { return pairs; }
   const std::vector<TiedInterface *> &Interfaces() const { return interfaces; }
   /// Fails for so many iterations, with the pairs whose active set the last
   /// Update() changed.
   bool FailIterations(int iterations);

private:
   void Search(const ImplicitStage &stage);
   /// Whether surfaces overlap by more than a fifth of the size of their faces.
   bool Overlaps() const;
   /// Moves bodies that the contact has let go of, and that a force pushes,
   /// until they touch.
   bool CatchPushed(ImplicitStage &stage);

   MPI_Comm comm;
   const std::vector<ContactPair *> &pairs;
   const std::vector<TiedInterface *> &interfaces;
   const std::vector<PushedBodies> &pushed;
   StageEquations &equations;
   BiphasicLinearSolver &linear;
   SolveRecord &record;
   /// Names of the pairs whose active set the last Update() changed.
   std::string unsettled;
};

} // namespace synovia
