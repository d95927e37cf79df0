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

   /// Whether it was evaluated at @a stage, on all ranks; its displacement at
   /// the start and what is conserved must be the same, Forget() otherwise.
   /// Collective.
   bool IsAt(const BodyStage &stage) const;
   /// Whether it was evaluated with this displacement, on all ranks.
   /// Collective.
   bool HasDisplacement(const mfem::Vector &displacement) const;
   /// Whether it was evaluated, but for round-off, at what @a stage begins
   /// with, on all ranks. Collective.
   bool IsAtStartOf(const BodyStage &stage) const;
   /// Takes the stage; the vectors below are the caller's to set.
   void Set(const BodyStage &stage);
   /// Length of the stage that was taken (time).
   mfem::real_t StageLength() const { return dt; }
   /// What else Mult() depends on has changed.
   void Forget() { known = false; }

   /// Whether both vectors are finite, on all ranks. Collective.
   bool IsFinite() const;

   mfem::Vector momentum;
   mfem::Vector mass;
   /// Of the mass, the growth of volume, and what flows in the stage: the
   /// stabilization is left.
   mfem::Vector growth;
   mfem::Vector flow;
   /// det F at all quadrature points of this rank.
   mfem::Vector volume_ratios;

private:
   MPI_Comm comm;
   bool known = false;
   mfem::real_t dt = 0.0;
   mfem::real_t time = 0.0;
   mfem::Vector u;
   mfem::Vector p;
   mfem::Vector p0;
};

} // namespace synovia
