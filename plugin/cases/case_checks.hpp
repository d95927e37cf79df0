#pragma once

#include "synovia/cases/case_file.hpp"

namespace synovia
{

/// Complains about what contradicts itself or makes no sense in a case, each
/// number being in range by itself.
void CheckConsistency(const CaseFile &setup, CaseReading &reading);

} // namespace synovia
