#include "synovia/fem/evaluated_balance.hpp"
#include "synovia/general/reduce.hpp"

#include <algorithm>
#include <cmath>

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

// But for what sums of increments make of them.
bool AreAlike(const Vector &a, const Vector &b)
{
   constexpr real_t round_off = 1e-13;
   if (a.Size() != b.Size())
   {
      return false;
   }
   a.HostRead();
   b.HostRead();
   const real_t size = a.Size() > 0 ? a.Normlinf() : 0.0;
   for (int i = 0; i < a.Size(); i++)
   {
      if (!(std::abs(a[i] - b[i]) <= round_off * size))
      {
         return false;
      }
   }
   return true;
}
} // namespace

bool EvaluatedBalance::IsAt(const BodyStage &stage) const
{
   const bool same = known && stage.dt == dt && stage.time == time &&
                     AreEqual(stage.u, u) && AreEqual(stage.p, p) &&
                     AreEqual(stage.p0, p0);
   return !AnyRank(!same, comm);
}

bool EvaluatedBalance::HasDisplacement(const Vector &displacement) const
{
   const bool same = known && AreEqual(displacement, u);
   return !AnyRank(!same, comm);
}

bool EvaluatedBalance::IsAtStartOf(const BodyStage &stage) const
{
   const bool alike = known && AreAlike(u, stage.u0) && AreAlike(p, stage.p0) &&
                      AreAlike(volume_ratios, stage.conserved0);
   return !AnyRank(!alike, comm);
}

void EvaluatedBalance::Set(const BodyStage &stage)
{
   known = true;
   dt = stage.dt;
   time = stage.time;
   u = stage.u;
   p = stage.p;
   p0 = stage.p0;
}

bool EvaluatedBalance::IsFinite() const
{
   const bool finite = momentum.CheckFinite() == 0 && mass.CheckFinite() == 0;
   return !AnyRank(!finite, comm);
}

} // namespace synovia
