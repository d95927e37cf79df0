#pragma once

#include "synovia/linalg/biphasic_linear_solver.hpp"
#include "synovia/physics/first_approach.hpp"
#include "synovia/physics/forcing_term.hpp"
#include "synovia/physics/rigid_freedoms.hpp"
#include "synovia/physics/stage_equations.hpp"

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace synovia
{

struct NonlinearOptions
{
   /// Newton iterations for one set of multipliers.
   int max_newton = 30;
   int max_augmentations = 30;
   /// Relative accuracy of a linear solve that suffices to see whether the
   /// active set changes; a set that doesn't is then solved to the end. 0
   /// solves every system to the end at once. In finite deformation systems
   /// are solved as accurately as ForcingTerm says, unless this is 0.
   mfem::real_t active_set_tolerance = 1e-4;
   LinearOptions linear;
   SolverTuning tuning;
};

/// What it took to solve the stages since the last BeginStep().
struct SolveReport
{
   bool converged = true;
   /// Why not, if not.
   std::string reason;
   int newton = 0;
   int augmentations = 0;
   int linear = 0;
   /// The most that one linear system took.
   int most_linear = 0;
   /// How far the linear systems' residuals fell, as decimal logarithms, all
   /// together.
   mfem::real_t decades = 0.0;
   int searches = 0;
};

/// Where the time goes, in seconds of this rank since the start.
struct PhaseTimes
{
   mfem::real_t assembly = 0.0;
   mfem::real_t search = 0.0;
   /// Hierarchies, factorizations and updates of preconditioners.
   mfem::real_t setup = 0.0;
   /// Linear systems without that.
   mfem::real_t linear = 0.0;
};

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
      const NonlinearOptions &options);

   void ImplicitSolve(const mfem::real_t dt, const mfem::Vector &x,
                      mfem::Vector &k) override;

   /// How the bodies come to where they start.
   const FirstApproach &Start() const { return start; }

   void BeginStep() { report = SolveReport(); }
   void AcceptStep();
   /// To be called before AcceptStep() where loads have a corner: the next step
   /// has other rates, and is not to be guessed from this one's.
   void ForgetRate();
   /// Goes back to what was accepted last: rates, multipliers, active and
   /// sealing sets, drained dofs, support forces and fluid balance.
   void RejectStep();
   /// Rate (v, dp/dt) of the last stage that was accepted.
   const mfem::Vector &AcceptedRate() const { return accepted.rate; }
   /// Lists what the next step needs of those accepted. Collective.
   void Archive(StateArchive &archive);
   const NonlinearOptions &Options() const { return options; }
   const SolveReport &Report() const { return report; }
   const PhaseTimes &Times() const { return times; }
   /// What was done since the start, rejected steps included.
   WorkCounts Work() const;

   const std::vector<ContactPair *> &Pairs() const { return pairs; }
   const StageEquations &Equations() const { return equations; }
   const BiphasicLinearSolver &LinearSolver() const { return *linear; }
   /// Of the last stage.
   const StageBalance &Balance() const { return balance; }

private:
   using Stage = ImplicitStage;

   /// Gaps and pressure jumps of all pairs.
   struct Violations
   {
      /// In the order of the pairs.
      std::vector<ContactViolations> pairs;
      /// Largest pressure (stress).
      mfem::real_t peak_pressure = 0.0;
      bool within_tolerance = true;
   };

   bool SolveStage(Stage &stage);
   /// Newton's method. Of nonlinear bodies it ends early where the active set
   /// has settled and multipliers are yet to be corrected: these change what
   /// the iterations converge to.
   bool SolveContact(Stage &stage, ResidualTolerance &tolerance);
   /// The same with partners where they belong.
   bool SolveSliding(Stage &stage, ResidualTolerance &tolerance);
   /// Decides what the first iteration linearizes: the guess, or the stage's
   /// start where the guess is none or impossible.
   void ChooseStart(Stage &stage);
   void Linearize(const BodyStage &stage);
   /// Adds the Newton step and evaluates the contact there. Of nonlinear bodies
   /// it adds as much as they can take and as doesn't make the residual, of
   /// which @a norm was the norm, grow; fails if that is next to nothing. With
   /// the active set as it is, @a residual is that of the new state then.
   bool TakeStep(const mfem::BlockVector &step, mfem::real_t norm,
                 const ResidualTolerance &tolerance, Stage &stage,
                 mfem::BlockVector &residual);
   /// Why the state can't follow one whose residual had this norm; empty if it
   /// can. Else @a residual is that of the state.
   std::string FindObstacle(const Stage &stage, mfem::real_t norm,
                            const ResidualTolerance &tolerance,
                            mfem::BlockVector &residual);
   /// Where the forces are least in balance.
   Point3 WorstPlace(const mfem::BlockVector &residual) const;
   /// Of the linear system for a residual of this norm.
   mfem::real_t LinearTarget(mfem::real_t norm, ForcingTerm &forcing) const;
   void Search(const Stage &stage);
   /// Brings the contact's derivatives to the last UpdateContact().
   void LinearizeContact(const Stage &stage);
   /// Lets pairs search anew whose points have gone to other partners, and
   /// evaluates them; says whether any did.
   bool SearchDrifted(Stage &stage);
   bool UpdateContact(Stage &stage);
   Violations FindViolations(const Stage &stage) const;
   /// Moves bodies that the contact has let go of, and that a force pushes,
   /// until they touch.
   bool CatchPushed(Stage &stage);
   ResidualTolerance Tolerance(const Stage &stage) const;
   /// Lowers the tolerance of the mass to a part of the fluid that the step, as
   /// solved, exchanges; false if that hardly changes it.
   bool Tighten(const Stage &stage, ResidualTolerance &tolerance) const;
   bool Fail(const std::string &reason);
   /// The same, with the bodies that are loose as contact is now.
   bool FailSolve(const std::string &reason);
   /// Whether a surface that a force moves would leave; fails if so.
   bool Escapes(const mfem::Vector &step);

   BiphasicSpaces &spaces;
   BoundaryConditions &conditions;
   std::vector<ContactPair *> pairs;
   NonlinearOptions options;
   PhaseTimes times;
   StageEquations equations;
   RigidFreedoms freedoms;
   FirstApproach start;
   /// Size of the mesh (length), where surfaces are driven.
   mfem::real_t extent = 0.0;
   std::unique_ptr<BiphasicLinearSolver> linear;
   SolveReport report;
   /// Without that of the linear solver.
   WorkCounts work;
   /// Names of the pairs whose active set the last UpdateContact() changed.
   std::string unsettled;
   /// Rate of the last stage, a first guess for the next one, and the stage's
   /// length.
   mfem::Vector rate;
   mfem::real_t rate_dt = 0.0;
   bool started = false;
   StageBalance balance;
   struct
   {
      mfem::Vector rate;
      mfem::real_t rate_dt = 0.0;
      bool started = false;
      StageBalance balance;
      mfem::Array<int> drained;
   } accepted;
};

} // namespace synovia
