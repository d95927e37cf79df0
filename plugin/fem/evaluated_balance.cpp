#include "synovia/fem/evaluated_balance.hpp"
#include "synovia/general/reduce.hpp"

#include <algorithm>

namespace synovia
{

using namespace mfem;

namespace
{
bool AreEqual(const Vector &a, const Vector &b)
{
   a.HostRead();
   b.HostRead();
   return a.Size() == b.Size() && std::equal(a.begin(), a.end(), b.begin());
}
} // namespace

bool EvaluatedBalance::IsAt(const BodyStage &stage) const
{
   const bool same = known && stage.dt == dt && stage.time == time &&
                     AreEqual(stage.u, u) && AreEqual(stage.p, p) &&
                     AreEqual(stage.p0, p0) &&
                     AreEqual(stage.conserved0, conserved0);
   return !AnyRank(!same, comm);
}

void EvaluatedBalance::Set(const BodyStage &stage)
{
   known = true;
   dt = stage.dt;
   time = stage.time;
   u = stage.u;
   p = stage.p;
   p0 = stage.p0;
   conserved0 = stage.conserved0;
}

bool EvaluatedBalance::IsFinite() const
{
   const bool finite = momentum.CheckFinite() == 0 && mass.CheckFinite() == 0;
   return !AnyRank(!finite, comm);
}

} // namespace synovia
