#pragma once

#include "cases/case_problem.hpp"

#include <string>
#include <vector>

namespace synovia
{

/// Bodies that fluid can't leave, or that only contact holds. Collective.
std::vector<std::string> FindBodyWarnings(const CaseFile &setup,
                                          CaseProblem &problem);

} // namespace synovia
