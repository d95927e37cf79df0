#pragma once

#include "synovia/cases/case_problem.hpp"
#include "synovia/materials/stiffness_range.hpp"

#include <vector>

namespace synovia
{

/// The range of each region's stiffness over its elements, by their attributes
/// in ascending order. Takes the eigenvalues of every element. Collective.
/// Throws Error if one of them is not positive definite, with the places of the
/// materials.
std::vector<StiffnessRange> VerifiedStiffness(const CaseFile &setup,
                                              CaseProblem &problem);

} // namespace synovia
