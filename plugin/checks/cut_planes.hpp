#pragma once

#include "synovia/cases/case_problem.hpp"
#include "synovia/fem/body.hpp"

#include <string>
#include <vector>

namespace synovia
{

/// Planes across an axis in which bodies end with faces that no condition
/// names, and which look like a plane of symmetry that was forgotten: another
/// surface there is one, several bodies end there, or the body has another
/// plane of symmetry and is not flat opposite. Collective.
std::vector<std::string> FindCutWarnings(const CaseFile &setup,
                                         CaseProblem &problem,
                                         const std::vector<Body> &bodies);

} // namespace synovia
