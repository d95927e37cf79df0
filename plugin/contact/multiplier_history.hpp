#pragma once

#include "mfem.hpp"

#include <array>

namespace synovia
{

/// Multipliers of gap and jump at two times, the later one second, and their
/// extrapolation.
struct MultiplierHistory
{
   /// Keeps the multipliers as those reached at @a now.
   void Store(mfem::real_t now, const mfem::Vector &traction_,
              const mfem::Vector &flux_);
   /// Extrapolates to time @a then, up to @a reach times the last interval
   /// ahead; farther, or from one time only, it takes the last multipliers. No
   /// traction becomes tensile.
   void Predict(mfem::real_t then, mfem::real_t reach, mfem::Vector &traction_,
                mfem::Vector &flux_) const;
   /// Leaves one time to predict from, as multipliers will change at another
   /// rate.
   void ForgetPast() { time[0] = time[1]; }

   std::array<mfem::real_t, 2> time{{0.0, 0.0}};
   std::array<mfem::Vector, 2> traction;
   std::array<mfem::Vector, 2> flux;
};

} // namespace synovia
