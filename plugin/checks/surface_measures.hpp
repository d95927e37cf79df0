#pragma once

#include "mesh/named_mesh.hpp"

#include <string>
#include <vector>

namespace synovia
{

struct SurfaceMeasures
{
   std::string name;
   long long faces = 0;
   mfem::real_t area = 0.0;
};

/// By name. Collective.
std::vector<SurfaceMeasures> MeasureSurfaces(NamedMesh &mesh);

} // namespace synovia
