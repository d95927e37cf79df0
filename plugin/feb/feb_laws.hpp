#pragma once

#include "synovia/cases/case_file.hpp"
#include "synovia/feb/feb_axes.hpp"

namespace synovia
{

/// Reads a solid, whose type is an attribute. Its fibers are in the material's
/// @a axes; @a frame is what the directions of the law refer to.
SolidCase ReadSolid(const FebInput &solid, const Tensor3<> &axes,
                    const FrameCase &frame);

/// Reads a permeability likewise; directions are those of the frame.
PermeabilityCase ReadPermeability(const FebInput &permeability);

} // namespace synovia
