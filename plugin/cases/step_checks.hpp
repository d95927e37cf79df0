#pragma once

#include "synovia/cases/case_file.hpp"

namespace synovia
{

/// Adds an error for each contradiction within the steps of a case, and, where
/// there are none, for those among what holds in the first step that has any.
void CheckSteps(const CaseFile &setup, CaseReading &reading);

} // namespace synovia
