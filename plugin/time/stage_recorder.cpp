#include "synovia/time/stage_recorder.hpp"

namespace synovia
{

using namespace mfem;

StageRecorder::StageRecorder(BiphasicOperator &op_)
   : TimeDependentOperator(op_.Height(), 0.0, IMPLICIT), op(op_)
{
}

void StageRecorder::ImplicitSolve(const real_t dt, const Vector &x, Vector &k)
{
   op.SetTime(GetTime());
   op.ImplicitSolve(dt, x, k);
   solves++;
   if (stages == static_cast<int>(rates.size()))
   {
      rates.emplace_back();
   }
   rates[stages] = k;
   stages++;
}

} // namespace synovia
