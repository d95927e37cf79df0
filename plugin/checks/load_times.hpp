#pragma once

#include "synovia/cases/case_file.hpp"

#include <limits>

namespace synovia
{

/// Lengths of time in which the loads of a case change.
struct LoadTimes
{
   mfem::real_t shortest = std::numeric_limits<mfem::real_t>::infinity();
   mfem::real_t longest = 0.0;
   /// When the last change ends.
   mfem::real_t last = 0.0;
};

LoadTimes FindLoadTimes(const CaseFile &setup);

} // namespace synovia
