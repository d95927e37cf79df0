#pragma once

#include "synovia/linalg/biphasic_linear_solver.hpp"
#include "synovia/physics/stage_equations.hpp"

#include <vector>

namespace synovia
{

/// How small the residual of a stage has to be: a part of what the step would
/// leave unbalanced if nothing moved but the supports, and no less than
/// round-off. All members are collective.
class ToleranceRule
{
public:
   /// Borrows all but @a relative, the part of momentum and mass.
   ToleranceRule(BiphasicSpaces &spaces, BoundaryConditions &conditions,
                 const std::vector<ContactPair *> &pairs,
                 const std::vector<TiedInterface *> &interfaces,
                 const StageEquations &equations, mfem::real_t relative);

   /// @a force_per_volume as BiphasicLinearSolver has it.
   ResidualTolerance Find(const ImplicitStage &stage,
                          mfem::real_t force_per_volume) const;
   /// Whether an iterate whose mass balance misses @a mass tells how much fluid
   /// the step exchanges: its @a residual of the mass, which leaves out what is
   /// exchanged, is a small part of it.
   bool KnowsExchange(const mfem::Vector &mass,
                      const mfem::Vector &residual) const;
   /// Lowers the tolerance of the mass to a part of the fluid that the step
   /// exchanges, where @a mass is what is missing for balance
   /// (StageEquations::ComputeImbalance); false if that hardly changes it.
   bool Tighten(const mfem::Vector &mass, ResidualTolerance &tolerance) const;
   /// Raises the tolerance to what round-off leaves at @a stage: a first guess,
   /// such as rest, may have had none.
   void AllowRoundOff(const ImplicitStage &stage,
                      ResidualTolerance &tolerance) const;

private:
   /// What round-off leaves of both equations, as norms.
   struct RoundOff
   {
      mfem::real_t momentum;
      mfem::real_t mass;
   };
   RoundOff FindRoundOff(const ImplicitStage &stage) const;
   /// Norm of the volumes that drained dofs exchange.
   mfem::real_t Exchanged(const mfem::Vector &mass) const;

   BiphasicSpaces &spaces;
   BoundaryConditions &conditions;
   const std::vector<ContactPair *> &pairs;
   const std::vector<TiedInterface *> &interfaces;
   const StageEquations &equations;
   mfem::real_t relative;
};

} // namespace synovia
