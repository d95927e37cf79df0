#pragma once

#include "cases/case_problem.hpp"

#include <limits>
#include <string>
#include <vector>

namespace synovia
{

/// What one region is and is made of.
struct RegionMeasures
{
   std::string name;
   int attribute = 0;
   long long elements = 0;
   mfem::real_t volume = 0.0;
   /// Scaled Jacobian of the worst element.
   mfem::real_t quality = std::numeric_limits<mfem::real_t>::infinity();
   mfem::real_t aggregate_modulus = 0.0;
   mfem::real_t permeability = 0.0;
   /// Volume over the area from which it drains; 0 if there is none.
   mfem::real_t thickness = 0.0;
   /// thickness^2 / (H_A kappa); 0 if it doesn't drain.
   mfem::real_t gel_time = 0.0;
};

/// In the order of their attributes. Collective.
std::vector<RegionMeasures> MeasureRegions(const CaseFile &setup,
                                           CaseProblem &problem);

/// Attributes of the surfaces from which fluid may leave.
mfem::Array<int> DrainingSurfaces(const CaseFile &setup, const NamedMesh &mesh);

} // namespace synovia
