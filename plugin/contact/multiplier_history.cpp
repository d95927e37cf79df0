#include "synovia/contact/multiplier_history.hpp"

#include <algorithm>

namespace synovia
{

using namespace mfem;

void MultiplierHistory::Store(real_t now, const Vector &traction_,
                              const Vector &flux_)
{
   time = {time[1], now};
   traction[0] = traction[1];
   traction[1] = traction_;
   flux[0] = flux[1];
   flux[1] = flux_;
}

void MultiplierHistory::Predict(real_t then, real_t reach, Vector &traction_,
                                Vector &flux_) const
{
   const real_t interval = time[1] - time[0];
   const real_t ahead = then - time[1];
   const real_t s =
      interval > 0.0 && ahead <= reach * interval ? ahead / interval : 0.0;
   add(1.0 + s, traction[1], -s, traction[0], traction_);
   add(1.0 + s, flux[1], -s, flux[0], flux_);
   for (int j = 0; j < traction_.Size(); j++)
   {
      traction_[j] = std::min(traction_[j], 0.0);
   }
}

} // namespace synovia
