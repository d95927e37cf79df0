#pragma once

#include "synovia/materials/solid_law.hpp"

namespace synovia
{

/// The least and the largest eigenvalue of a stiffness, as a symmetric map of
/// strain tensors to stress tensors (stress).
struct StiffnessRange
{
   mfem::real_t least;
   mfem::real_t largest;
};

/// Of a stiffness as SolidLaw::GetStiffness() gives it; its entries must be
/// finite.
StiffnessRange RangeOfStiffness(mfem::DenseMatrix stiffness);

/// The same at the center of an element.
StiffnessRange RangeOfStiffness(const SolidLaw &law,
                                mfem::ElementTransformation &trans);

} // namespace synovia
