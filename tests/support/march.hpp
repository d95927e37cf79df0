#pragma once

#include "synovia/physics/biphasic_problem.hpp"

namespace synovia
{

/// Marches a problem with any of MFEM's ODE solvers and with steps of any
/// length, from rest at time 0. This is how a program of one's own drives a
/// BiphasicOperator; a TimeStepper does it with steps of one length.
class March
{
public:
   /// Borrows @a problem and assembles it if need be. Collective.
   explicit March(BiphasicProblem &problem);

   /// One step of length @a dt; says whether it converged. Collective.
   bool Step(mfem::ODESolver &solver, mfem::real_t dt);

   mfem::real_t Time() const { return time; }
   /// Displacement and pressure, true dofs.
   const mfem::BlockVector &State() const { return state; }
   /// Fields of the state; they follow each step.
   mfem::ParGridFunction &Displacement() { return displacement; }
   mfem::ParGridFunction &Pressure() { return pressure; }

private:
   BiphasicOperator &op;
   mfem::BlockVector state;
   mfem::ParGridFunction displacement;
   mfem::ParGridFunction pressure;
   mfem::real_t time = 0.0;
};

} // namespace synovia
