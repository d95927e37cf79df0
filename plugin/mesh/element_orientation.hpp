#pragma once

#include "synovia/mesh/face_sides.hpp"
#include "synovia/mesh/flat_mesh.hpp"

#include <vector>

namespace synovia
{

/// Renumbers left-handed elements.
///
/// Elements that share a face come to see it from opposite sides, and every
/// connected body gets the handedness that makes most of its volumes positive.
/// So a file that numbers elements in any sense is read right, and an element
/// turned inside out by a moved node still has a negative volume.
/// @a mirrored has for each shape the order of its nodes in a mirror. Returns
/// the number of renumbered elements; if there are any, the face numbers in
/// @a sides are out of date. Throws Error if the elements at a face do not have
/// the same edges there.
int OrientElements(FlatMesh &mesh, const std::vector<FaceSide> &sides,
                   const std::vector<std::vector<int>> &mirrored);

} // namespace synovia
