#pragma once

#include "synovia/mesh/named_mesh.hpp"

namespace synovia
{

/// @{
/// Collective: integrals over all ranks by quadrature.
mfem::real_t RegionVolume(const NamedMesh &mesh, const std::string &region);
mfem::real_t BoundaryArea(const NamedMesh &mesh, const std::string &boundary);
/// @}

} // namespace synovia
