#pragma once

#include "synovia/feb/feb_materials.hpp"

namespace synovia
{

/// Places of the parts of those rigid bodies a surface of which is in a pair:
/// all of the body's.
std::set<int> FindTouchingParts(const FebMesh &mesh,
                                const FebMaterials &materials);

/// Makes thin elements of the shells among @a parts, on the other side of what
/// their facets in pairs touch; an element's own facets count where it is in no
/// pair.
void ThickenShells(const std::set<int> &parts, FebMesh &mesh);

} // namespace synovia
