#pragma once

#include "synovia/physics/biphasic_operator.hpp"

#include <vector>

namespace synovia
{

/// Stands between an ODE solver and a BiphasicOperator, and records the rates
/// of the stages, which MFEM's solvers don't give out.
class StageRecorder : public mfem::TimeDependentOperator
{
public:
   /// Borrows @a op.
   explicit StageRecorder(BiphasicOperator &op);

   void ImplicitSolve(const mfem::real_t dt, const mfem::Vector &x,
                      mfem::Vector &k) override;

   /// Forgets the stages so far.
   void Clear() { stages = 0; }
   int Stages() const { return stages; }
   /// Rates of the stages since, in their order.
   const mfem::Vector &Rate(int stage) const { return rates[stage]; }
   /// All implicit solves ever.
   int Solves() const { return solves; }

private:
   BiphasicOperator &op;
   std::vector<mfem::Vector> rates;
   int stages = 0;
   int solves = 0;
};

} // namespace synovia
