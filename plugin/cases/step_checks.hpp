#pragma once

#include "synovia/cases/case_file.hpp"

namespace synovia
{

/// Adds errors for more time steps in a @a duration, whose @a meaning messages
/// name, than can be wanted, and for lengths of time steps that contradict each
/// other.
void CheckStepLengths(mfem::real_t duration, const std::string &meaning,
                      const TimeOptions &time, const std::string &path,
                      CaseReading &reading);

/// Adds an error for each contradiction within the steps of a case, and, where
/// there are none, for those among what holds in the first step that has any.
void CheckSteps(const CaseFile &setup, CaseReading &reading);

} // namespace synovia
