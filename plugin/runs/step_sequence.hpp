#pragma once

#include "synovia/cases/case_problem.hpp"
#include "synovia/cases/case_steps.hpp"
#include "synovia/time/time_stepper.hpp"

#include <memory>
#include <vector>

namespace synovia
{

/// The steps of a case one after the other: each has a problem and a stepper of
/// its own, which go on from the state that the one before has reached. A case
/// without steps is one step. All members are collective.
class StepSequence
{
public:
   /// Begins with the first step. Borrows @a mesh. Throws Error if one of the
   /// steps doesn't fit the mesh or contradicts itself.
   StepSequence(const CaseFile &setup, NamedMesh &mesh);

   const CaseOfStep &Present() const { return steps[present]; }
   /// Number of the present step, from 1.
   int Number() const { return static_cast<int>(present) + 1; }
   bool IsLast() const { return present + 1 == steps.size(); }
   CaseProblem &Problem() { return *problem; }
   /// Assembles the problem at the first call in a step.
   TimeStepper &Stepper();

   /// Whether the state is the one that the step before has reached.
   bool IsAtBeginning();
   /// Largest difference between displacements that are prescribed now and what
   /// they are (length); 0 where it is round-off.
   mfem::real_t Jump();
   bool StepIsDone() const { return stepper && stepper->Done(); }
   /// Names of the steps that have not come to their ends, in order.
   std::vector<std::string> NamesToReach();
   /// Of all problems so far.
   PhaseTimes Times() const;
   /// Time steps to the end of the run, as long as they would be now.
   int StepsLeft() const;

   /// Goes to the step that a state of this time is in, before there is a
   /// stepper; at the end of a step to that one, not to the next.
   void GoTo(mfem::real_t time);
   /// Begins the next step. Problem() and Stepper() are others then.
   void Advance();

private:
   void Begin(size_t step);

   std::vector<CaseOfStep> steps;
   NamedMesh &mesh;
   size_t present = 0;
   std::unique_ptr<CaseProblem> problem;
   std::unique_ptr<TimeStepper> stepper;
   /// In the steps before.
   PhaseTimes spent;
};

} // namespace synovia
