#pragma once

#include "synovia/feb/feb_model.hpp"

namespace synovia
{

/// Whether a connector's type is that of a joint which ReadJoint() knows.
bool IsJointType(const std::string &type);
/// The types.
std::string JointTypes();

/// Adds a joint between rigid bodies to the case.
void ReadJoint(const FebInput &joint, FebModel &model);

} // namespace synovia
