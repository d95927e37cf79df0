#include "synovia/contact/clearance.hpp"
#include "synovia/general/reduce.hpp"

#include <algorithm>

namespace synovia
{

using namespace mfem;

void Clearance::TakeLess(const Clearance &other)
{
   ahead = std::min(ahead, other.ahead);
   behind = std::min(behind, other.behind);
   touches = touches || other.touches;
}

Clearance FindClearance(const ContactPair &pair, const Vector &motion)
{
   // Surfaces that slide along each other hardly come nearer.
   constexpr real_t slides = 0.2;
   const ContactCoverage &coverage = pair.Constraint().Coverage();
   Vector closing(coverage.area.Size());
   pair.Factors().gap_change->Mult(-1.0, motion, 0.0, closing);
   closing.HostRead();
   Clearance clearance;
   for (int j = 0; j < closing.Size(); j++)
   {
      const real_t gap = pair.State().gap[j];
      if (!(coverage.area[j] > 0.0) || std::abs(closing[j]) < slides)
      {
         continue;
      }
      if (closing[j] < 0.0)
      {
         clearance.behind = std::min(clearance.behind, -gap / closing[j]);
         continue;
      }
      clearance.ahead = std::min(clearance.ahead, gap / closing[j]);
      clearance.touches = clearance.touches || gap < coverage.GrazingGap(j);
   }
   MPI_Comm comm = pair.Geometry().Source().Spaces().GetComm();
   clearance.ahead = -MaxOverRanks(-clearance.ahead, comm);
   clearance.behind = -MaxOverRanks(-clearance.behind, comm);
   clearance.touches = AnyRank(clearance.touches, comm);
   return clearance;
}

} // namespace synovia
