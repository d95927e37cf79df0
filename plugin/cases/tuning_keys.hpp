#pragma once

#include "synovia/cases/key_table.hpp"

namespace synovia
{

/// The keys of solver.tuning: a table for each group of SolverTuning.
KeyTable TuningKeys(SolverTuning &tuning);

} // namespace synovia
