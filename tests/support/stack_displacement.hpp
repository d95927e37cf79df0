#pragma once

#include "synovia/fem/biphasic_spaces.hpp"

#include <functional>

namespace synovia
{

/// True dofs of a displacement that has a formula on each body of
/// MakeStackMesh(): u at x. Collective.
inline mfem::Vector StackDisplacement(
   BiphasicSpaces &spaces,
   std::function<void(const mfem::Vector &, mfem::Vector &)> on_lower,
   std::function<void(const mfem::Vector &, mfem::Vector &)> on_upper)
{
   mfem::VectorFunctionCoefficient lower(3, std::move(on_lower));
   mfem::VectorFunctionCoefficient upper(3, std::move(on_upper));
   mfem::PWVectorCoefficient by_body(3);
   by_body.UpdateCoefficient(1, lower);
   by_body.UpdateCoefficient(2, upper);
   mfem::ParGridFunction projected(&spaces.Displacement());
   projected.ProjectCoefficient(by_body);
   mfem::Vector u;
   projected.GetTrueDofs(u);
   return u;
}

} // namespace synovia
