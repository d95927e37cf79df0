#pragma once

#include "synovia/physics/carried_nodes.hpp"
#include "synovia/physics/rate_history.hpp"
#include "synovia/physics/stage_solver.hpp"

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace synovia
{

/// All bodies of a biphasic problem with their contact, as an MFEM ODE.
///
/// The state is x = (u, p), true dofs of displacement and pressure; its rate is
/// k = (v, dp/dt). ImplicitSolve() finds k such that u + dt v and p + dt dp/dt
/// satisfy momentum balance, mass balance with the solid velocity v, boundary
/// conditions, and contact at the time of the stage. The pressure is algebraic
/// (except for the stabilization), so a scheme should be stiffly accurate, as
/// BackwardEulerSolver and SDIRK33Solver are.
///
/// One step is: BeginStep(), ODESolver::Step(), and then either AcceptStep()
/// or, if Report().converged is false, RejectStep() together with the old
/// state.
///
/// Large because steppers, histories and checkpoints each ask for other results
/// of a step.
class BiphasicOperator : public mfem::TimeDependentOperator
{
public:
   /// Takes the bodies from @a make_bodies, whose time counts as assembly, and
   /// lets those that a force moves approach what they press on. Borrows all
   /// other arguments; the boundary conditions must be complete. Collective.
   /// Throws Error where such a body meets nothing.
   BiphasicOperator(
      BiphasicSpaces &spaces, const std::vector<Body> &body_list,
      const std::function<std::unique_ptr<BodyForm>()> &make_bodies,
      BoundaryConditions &conditions, std::vector<ContactPair *> pairs,
      std::vector<TiedInterface *> interfaces, const NonlinearOptions &options);

   void ImplicitSolve(const mfem::real_t dt, const mfem::Vector &x,
                      mfem::Vector &k) override;

   /// How the bodies come to where they start.
   const FirstApproach &Start() const { return start; }

   /// From the state @a x that was accepted last. Collective.
   void BeginStep(const mfem::Vector &x);
   void AcceptStep();
   /// To be called before AcceptStep() where loads have a corner: the next step
   /// has other rates, and is not to be guessed from this one's.
   void ForgetRate();
   /// Lets relative conditions since time @a t count from the displacement
   /// @a u, true dofs, and guesses the next step from nothing.
   void BeginAnew(mfem::real_t t, const mfem::Vector &u);
   /// Goes back to what was accepted last: rates, multipliers, active and
   /// sealing sets, drained dofs, support forces and fluid balance.
   void RejectStep();
   /// Rate (v, dp/dt) of the last stage that was accepted.
   const mfem::Vector &AcceptedRate() const { return accepted.rates.Last(); }
   /// Lists what the next step needs of those accepted. Collective.
   void Archive(StateArchive &archive);
   const NonlinearOptions &Options() const { return options; }
   /// Since the last BeginStep().
   const SolveReport &Report() const { return record.report; }
   const PhaseTimes &Times() const { return record.times; }
   /// What was done since the start, rejected steps included.
   WorkCounts Work() const;

   const std::vector<ContactPair *> &Pairs() const { return pairs; }
   const std::vector<TiedInterface *> &Interfaces() const { return interfaces; }
   const StageEquations &Equations() const { return equations; }
   const BiphasicLinearSolver &LinearSolver() const
   {
      return solver.LinearSolver();
   }
   /// Of the last stage.
   const StageBalance &Balance() const { return balance; }
   /// Where rigid bodies are, of the last stage.
   const RigidPoses &Poses() const { return poses; }

private:
   /// The stage from @a x on: loads, supports, and a first guess by the rate
   /// that may be expected, or none where that is impossible.
   ImplicitStage StartStage(mfem::real_t dt, const mfem::Vector &x);
   /// Where all would be after @a dt at the @a rate, and supports where they
   /// are at the end of the stage.
   void Guess(mfem::real_t dt, const mfem::Vector &rate, ImplicitStage &stage);
   /// Lets bodies that are carried deform as seen from what carries them: what
   /// turns doesn't go along lines.
   void GuessCarried(mfem::real_t dt, const mfem::Vector &rate,
                     ImplicitStage &stage) const;
   /// Where all that isn't carried rests, if what is turns so far that linear
   /// extrapolation would distort it; with the stage's poses.
   std::optional<ImplicitStage::State>
   CarriedAlong(const ImplicitStage &stage) const;

   BiphasicSpaces &spaces;
   BoundaryConditions &conditions;
   std::vector<ContactPair *> pairs;
   std::vector<TiedInterface *> interfaces;
   NonlinearOptions options;
   SolveRecord record;
   StageEquations equations;
   FirstApproach start;
   CarriedNodes carried;
   StageSolver solver;
   RateHistory rates{spaces};
   bool started = false;
   StageBalance balance;
   RigidPoses poses;
   struct Accepted
   {
      explicit Accepted(const RateHistory &rates_) : rates(rates_) {}

      RateHistory rates;
      bool started = false;
      StageBalance balance;
      RigidPoses poses;
      mfem::Array<int> drained;
   } accepted{rates};
};

} // namespace synovia
