#pragma once

#include "mfem.hpp"

namespace synovia
{

/// Two implicit stages of order two, L-stable and stiffly accurate (Alexander,
/// SIAM J Numer Anal 14(6):1006-1021, 1977): the last stage is the end of the
/// step. Where equations have constraints, as those of contact do, forces and
/// multipliers of the last stage are thus those of the new state, which they
/// are not with MFEM's schemes of two stages.
class Sdirk2Solver : public mfem::ODESolver
{
public:
   /// 1 - 1 / sqrt(2): the part of the step that is left for the last stage.
   static constexpr mfem::real_t gamma = 0.292893218813452476;

   void Init(mfem::TimeDependentOperator &f) override;
   void Step(mfem::Vector &x, mfem::real_t &t, mfem::real_t &dt) override;

private:
   mfem::Vector first;
   mfem::Vector second;
};

} // namespace synovia
