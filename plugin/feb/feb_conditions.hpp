#pragma once

#include "synovia/feb/feb_model.hpp"

namespace synovia
{

/// Adds a condition of one surface to the case of the model. Of two on the same
/// surface FEBio takes the prescribed displacement or pressure before zero, and
/// the later one before the earlier; loads add up. Stops the import at
/// @a where if that is not known here.
void AddCondition(BoundaryCase condition, const FebInput &where,
                  FebModel &model);

/// Lets what is prescribed hold at nodes that other surfaces hold at zero, as
/// FEBio does: at shared nodes the later condition of a case counts. For those
/// of the step that is being read, or those of all steps.
void PutZerosFirst(FebModel &model);

} // namespace synovia
