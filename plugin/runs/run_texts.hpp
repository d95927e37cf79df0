#pragma once

#include "synovia/fem/biphasic_spaces.hpp"
#include "synovia/physics/biphasic_operator.hpp"
#include "synovia/time/time_stepper.hpp"

#include <string>

namespace synovia
{

// Lines of the log of a run.

/// How large it is, and how long it took to set up (s). Collective.
std::string SizeText(BiphasicSpaces &spaces, double seconds);

/// What a step came to.
std::string StepText(int step, const StepReport &report);

/// What the time was spent on, in all and for output (s).
std::string PhaseText(const PhaseTimes &phases, double total, double output);

} // namespace synovia
