#pragma once

#include "synovia/cases/case_file.hpp"

namespace synovia
{

/// Adds an error for each contradiction among what connects rigid bodies.
void CheckConnections(const CaseFile &setup, CaseReading &reading);

} // namespace synovia
