#pragma once

#include "synovia/feb/feb_input.hpp"
#include "synovia/general/point3.hpp"
#include "synovia/materials/tensor3.hpp"

namespace synovia
{

/// The axes of a material, in columns: those of the element mat_axis in
/// @a material, or those of space if there is none. Axes that differ from
/// element to element stop the import.
Tensor3<> ReadAxes(const FebInput &material);

/// The unit vector that the element fiber in @a law describes, in the axes of
/// its material; the first axis if there is none.
Point3 ReadFiber(const FebInput &law);

} // namespace synovia
