#pragma once

#include "synovia/fem/body_form.hpp"

namespace synovia
{

/// BodyForm::Mult() where it was evaluated last, so that integrals over the
/// bodies are taken once for each state: line searches, active sets and
/// diagnostics ask for them again.
class EvaluatedBalance
{
public:
   explicit EvaluatedBalance(MPI_Comm comm_) : comm(comm_) {}

   /// Whether it was evaluated at @a stage, on all ranks. Collective.
   bool IsAt(const BodyStage &stage) const;
   /// Takes the stage; the vectors below are the caller's to set.
   void Set(const BodyStage &stage);
   /// What else Mult() depends on has changed.
   void Forget() { known = false; }

   /// Whether both vectors are finite, on all ranks. Collective.
   bool IsFinite() const;

   mfem::Vector momentum;
   mfem::Vector mass;

private:
   MPI_Comm comm;
   bool known = false;
   mfem::real_t dt = 0.0;
   mfem::real_t time = 0.0;
   mfem::Vector u;
   mfem::Vector p;
   mfem::Vector p0;
   mfem::Vector conserved0;
};

} // namespace synovia
