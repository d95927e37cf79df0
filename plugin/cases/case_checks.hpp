#pragma once

#include "synovia/cases/case_file.hpp"

namespace synovia
{

/// Adds an error for each contradiction within a case; ranges of single numbers
/// are checked with the keys.
void CheckConsistency(const CaseFile &setup, CaseReading &reading);

/// Adds those among boundaries, rigid bodies and contact pairs.
void CheckConditions(const CaseFile &setup, CaseReading &reading);

} // namespace synovia
