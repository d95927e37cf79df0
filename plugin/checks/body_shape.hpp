#pragma once

#include "synovia/cases/case_problem.hpp"
#include "synovia/fem/body.hpp"

#include <vector>

namespace synovia
{

/// Thickness of each body under its loads: the median, by area, of the
/// distances along the normals from its contact surfaces, or from its other
/// loaded surfaces if it has none, to its far side. 0 without such surfaces.
/// Collective.
std::vector<mfem::real_t> MeasureThickness(const CaseFile &setup,
                                           CaseProblem &problem,
                                           const std::vector<Body> &bodies);

/// How far fluid has to go, for each region attribute: the largest distance of
/// its elements' corners and centers to the surfaces from which the fluid of
/// its body leaves. 0 where there are none. Collective.
std::vector<mfem::real_t>
MeasureDrainageLengths(const CaseFile &setup, CaseProblem &problem,
                       const std::vector<Body> &bodies);

/// Attributes of the surfaces from which fluid may leave.
mfem::Array<int> DrainingSurfaces(const CaseFile &setup, const NamedMesh &mesh);

/// The attribute of the region that has a boundary element of this rank.
int RegionBehind(const mfem::ParMesh &mesh, int boundary_element);

/// The number of the body that each region attribute belongs to, or -1.
std::vector<int> BodyOfRegions(const std::vector<Body> &bodies, int attributes);

} // namespace synovia
