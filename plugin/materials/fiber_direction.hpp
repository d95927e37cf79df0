#pragma once

#include "synovia/materials/material_frame.hpp"
#include "synovia/materials/material_point.hpp"
#include "synovia/materials/tensor3.hpp"

namespace synovia
{

/// The axis theta of @a frame at a point of the undeformed body.
Vector3<> FiberDirection(const MaterialPoint &point,
                         const MaterialFrame &frame);

} // namespace synovia
