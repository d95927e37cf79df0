#pragma once

#include "synovia/contact/contact_coverage.hpp"
#include "synovia/contact/contact_surface.hpp"

#include <vector>

namespace synovia
{

/// Means of a function around the vertices, int phi_j f / int phi_j over what
/// the source covers, or zero where it covers nothing. The function has
/// @a values at the destination's vertices, as the result has, and is linear
/// between them. Of a face that is covered in part, each vertex's
/// part counts as on the whole face. Collective.
mfem::Vector VertexMeans(const ContactSurface &destination,
                         const std::vector<FaceCoverage> &coverage,
                         const mfem::Vector &values);

/// Area where such a function is negative, of what the source covers, on all
/// ranks. Quadrilaterals consist of four triangles around their center. Of a
/// face that is covered in part, each vertex's part counts as on the whole
/// face. Collective.
mfem::real_t NegativeArea(const ContactSurface &destination,
                          const std::vector<FaceCoverage> &coverage,
                          const mfem::Vector &values);

} // namespace synovia
