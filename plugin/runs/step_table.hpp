#pragma once

#include "synovia/cases/case_file.hpp"

#include <iosfwd>

namespace synovia
{

/// Writes the steps of a case, with what each changes, if it has any.
void WriteSteps(const CaseFile &setup, std::ostream &out);

} // namespace synovia
