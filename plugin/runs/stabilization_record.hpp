#pragma once

#include "synovia/fem/strain_monitor.hpp"

#include <string>

namespace synovia
{

/// The largest StabilizedVolume of a run so far, and the warning that it
/// causes: beyond 5 %, strains are no longer those of the tissue.
class StabilizationRecord
{
public:
   /// Takes in an accepted step; gives a warning when the limit is passed for
   /// the first time, else nothing.
   std::string Add(const StrainExtreme &part, mfem::real_t time);

   /// Where it was passed, the largest part with place and time.
   std::string Summary() const;

private:
   StrainExtreme largest;
   mfem::real_t largest_time = 0.0;
   bool warned = false;
};

} // namespace synovia
