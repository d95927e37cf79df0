#pragma once

#include "synovia/cases/case_problem.hpp"
#include "synovia/fem/body.hpp"

#include <string>
#include <vector>

namespace synovia
{

/// What one region is made of, and how far it is through it.
struct RegionMeasures
{
   std::string name;
   int attribute = 0;
   /// Whether it is part of a rigid body.
   bool rigid = false;
   mfem::real_t aggregate_modulus = 0.0;
   /// 0 without fluid.
   mfem::real_t permeability = 0.0;
   /// Of its body, under what presses it; 0 if nothing does, or if it is rigid.
   mfem::real_t thickness = 0.0;
   /// The farthest that fluid has to go to leave its body; 0 if it can't.
   mfem::real_t drainage_length = 0.0;
   /// drainage_length^2 / (H_A kappa)
   mfem::real_t gel_time = 0.0;
};

/// In the order of their attributes. Collective.
std::vector<RegionMeasures> MeasureRegions(const CaseFile &setup,
                                           CaseProblem &problem,
                                           const std::vector<Body> &bodies);

} // namespace synovia
