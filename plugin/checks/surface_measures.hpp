#pragma once

#include "synovia/cases/case_file.hpp"
#include "synovia/general/point3.hpp"
#include "synovia/mesh/named_mesh.hpp"

#include <string>
#include <vector>

namespace synovia
{

struct SurfaceMeasures
{
   std::string name;
   long long faces = 0;
   mfem::real_t area = 0.0;
   /// What applies there; parts that differ are joined by slashes.
   std::string conditions;
};

/// By name, and then the outer faces without a name, if there are any.
/// Collective.
std::vector<SurfaceMeasures> MeasureSurfaces(const CaseFile &setup,
                                             NamedMesh &mesh);

struct DirectedArea
{
   /// The integral of the outward normals.
   Point3 vector{{0.0, 0.0, 0.0}};
   mfem::real_t area = 0.0;
};

/// By attribute, curved faces as flat pieces. Collective.
std::vector<DirectedArea> MeasureDirectedAreas(NamedMesh &mesh);

} // namespace synovia
