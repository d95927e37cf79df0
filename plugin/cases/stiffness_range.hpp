#pragma once

#include "materials/solid_law.hpp"

namespace synovia
{

/// The least and the largest eigenvalue of a stiffness, as a symmetric map of
/// strain tensors to stress tensors (stress).
struct StiffnessRange
{
   mfem::real_t least;
   mfem::real_t largest;
};

/// At the centre of an element.
StiffnessRange RangeOfStiffness(const SolidLaw &law,
                                mfem::ElementTransformation &trans);

} // namespace synovia
