#pragma once

#include "synovia/cases/case_file.hpp"

namespace synovia
{

/// Adds errors for laws of a material that are not for this deformation, and
/// for parameters that they don't have.
void CheckLaws(const MaterialCase &material, const std::string &path,
               Deformation deformation, CaseReading &reading);

} // namespace synovia
