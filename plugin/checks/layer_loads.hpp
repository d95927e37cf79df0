#pragma once

#include "synovia/checks/contact_check.hpp"
#include "synovia/checks/region_measures.hpp"
#include "synovia/fem/body.hpp"

#include <string>
#include <vector>

namespace synovia
{

/// A boundary that moves towards its body, and what it has to press.
struct LayerApproach
{
   /// Number of the boundary in the case, and name of the body.
   int boundary = 0;
   std::string body;
   /// The largest prescribed displacement along the mean normal (length).
   mfem::real_t displacement = 0.0;
   /// Thickness of the body and of the thickest that it may touch, with the
   /// gap between them (length).
   mfem::real_t depth = 0.0;
};

/// A boundary with a traction or a force on it.
struct LayerStress
{
   int boundary = 0;
   std::string body;
   /// The largest of the run: traction, or force over area (stress).
   mfem::real_t stress = 0.0;
   bool is_force = false;
   /// The least aggregate modulus of the body and of those that it may touch
   /// (stress).
   mfem::real_t modulus = 0.0;
};

struct LayerLoads
{
   std::vector<LayerApproach> approaches;
   std::vector<LayerStress> stresses;
};

/// What presses the bodies of a case, as far as they have a thickness. @a pairs
/// are those of CheckContact(), or none: then gaps count nothing. Collective.
LayerLoads FindLayerLoads(const CaseFile &setup, CaseProblem &problem,
                          const std::vector<PairAtStart> &pairs,
                          const std::vector<Body> &bodies,
                          const std::vector<RegionMeasures> &regions);

/// The largest absolute value of a load curve.
mfem::real_t Amplitude(const LoadCurve &curve);

} // namespace synovia
