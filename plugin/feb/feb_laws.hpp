#pragma once

#include "synovia/cases/case_file.hpp"
#include "synovia/feb/feb_axes.hpp"

namespace synovia
{

/// Reads a solid, whose type is an attribute. Its fibers are in the material's
/// @a axes; @a frame is what the directions of the law refer to.
SolidCase ReadSolid(const FebInput &solid, const Tensor3<> &axes,
                    const FrameCase &frame);

/// Whether a type is that of a solid which ReadSolid() knows.
bool IsSolidType(const std::string &type);

/// Reads a permeability likewise; it is along the axes of @a frame. One that
/// can't be stops the import.
PermeabilityCase ReadPermeability(const FebInput &permeability,
                                  const Tensor3<> &axes,
                                  const FrameCase &frame);

/// Multiplies the permeability by a factor.
void Scale(mfem::real_t factor, PermeabilityCase &permeability);

} // namespace synovia
