#pragma once

#include "synovia/cases/case_file.hpp"
#include "synovia/feb/feb_frame.hpp"

namespace synovia
{

/// Reads a solid, whose type is an attribute; its directions refer to the
/// frame.
SolidCase ReadSolid(const FebInput &solid, FebFrame &frame);

/// Whether a type is that of a solid which ReadSolid() knows.
bool IsSolidType(const std::string &type);

/// Reads a permeability likewise; it is along the axes of @a frame. One that
/// can't be stops the import.
PermeabilityCase ReadPermeability(const FebInput &permeability,
                                  FebFrame &frame);

/// Multiplies the permeability by a factor.
void Scale(mfem::real_t factor, PermeabilityCase &permeability);

} // namespace synovia
