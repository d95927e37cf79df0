#pragma once

#include "synovia/mesh/named_mesh.hpp"

#include <limits>
#include <string>
#include <vector>

namespace synovia
{

/// The elements of one region.
struct ElementMeasures
{
   long long elements = 0;
   mfem::real_t volume = 0.0;
   /// Scaled Jacobian of the worst one.
   mfem::real_t quality = std::numeric_limits<mfem::real_t>::infinity();
};

/// Of the regions in the order of their attributes. Integrates every element:
/// too expensive for the warnings of a run. Collective.
std::vector<ElementMeasures> MeasureElements(NamedMesh &mesh);

/// Regions with elements that are nearly flat.
std::vector<std::string>
FindQualityWarnings(const NamedMesh &mesh,
                    const std::vector<ElementMeasures> &regions);

} // namespace synovia
