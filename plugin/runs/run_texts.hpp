#pragma once

#include "synovia/cases/case_steps.hpp"
#include "synovia/fem/biphasic_spaces.hpp"
#include "synovia/fem/strain_monitor.hpp"
#include "synovia/physics/biphasic_operator.hpp"
#include "synovia/time/time_stepper.hpp"

#include <string>

namespace synovia
{

// Lines of the log of a run.

/// Size of the problem, and time of its set-up (s). Collective.
std::string SizeText(BiphasicSpaces &spaces, double seconds);

/// Which step of the case begins.
std::string BeginText(const CaseOfStep &step);

/// A warning of displacements that begin so far (length) from where they are.
std::string JumpText(mfem::real_t jump);

/// Region and place of an extreme.
std::string PlaceText(const StrainExtreme &extreme);

/// Result of a step.
std::string StepText(int step, const StepReport &report);

/// Times by phase, in total and for output (s).
std::string PhaseText(const PhaseTimes &phases, double total, double output);

} // namespace synovia
