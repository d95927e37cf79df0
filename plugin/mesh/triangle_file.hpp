#pragma once

#include "synovia/mesh/surface_sheet.hpp"

#include <string>

namespace synovia
{

/// Reads triangles, and quadrilaterals, from an STL file, ascii or binary, or
/// from an MSH file: curved ones count by their corners. Corners at the same
/// place are one. @a scale is a factor on coordinates; what is below the
/// surface is left empty. Throws Error, whose text does not name the file, if
/// it is no such file, if it has no facets, or if more than two of them meet in
/// an edge or two have different sides outside.
SurfaceSheet ReadFacets(const std::string &path, mfem::real_t scale);

/// Puts the places below the surface against the mean normals of the facets
/// around, at a small part of the shortest edge.
void Thicken(SurfaceSheet &sheet);

} // namespace synovia
