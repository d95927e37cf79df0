#pragma once

#include "synovia/cases/case_problem.hpp"
#include "synovia/checks/contact_check.hpp"
#include "synovia/checks/element_measures.hpp"
#include "synovia/checks/region_measures.hpp"
#include "synovia/checks/surface_measures.hpp"
#include "synovia/checks/tie_check.hpp"
#include "synovia/fem/body.hpp"
#include "synovia/materials/stiffness_range.hpp"

#include <iosfwd>
#include <string>
#include <vector>

namespace synovia
{

/// A summary of a case before it runs: regions, surfaces, materials, pairs,
/// unknowns, and what looks like a mistake.
class ProblemReport
{
public:
   /// Collective. Throws Error if a contact pair or a tie can't be, or if a
   /// material's stiffness isn't positive definite.
   ProblemReport(const CaseFile &setup, CaseProblem &problem);

   /// Writes it for people to read.
   void Write(std::ostream &out) const;

   /// What looks like a mistake, a sentence each.
   const std::vector<std::string> &Warnings() const { return warnings; }

   /// What would make it more accurate, likewise.
   const std::vector<std::string> &Hints() const { return hints; }

   const std::vector<RegionMeasures> &Regions() const { return regions; }
   const std::vector<SurfaceMeasures> &Surfaces() const { return surfaces; }

private:
   void Count(const CaseFile &setup, CaseProblem &problem);
   void WriteRegions(std::ostream &out) const;
   void WriteSurfaces(std::ostream &out) const;
   void WritePairs(std::ostream &out) const;

   std::string title;
   int ranks = 1;
   int order = 2;
   std::vector<Body> bodies;
   std::vector<RegionMeasures> regions;
   std::vector<ElementMeasures> elements;
   std::vector<StiffnessRange> stiffness;
   std::vector<SurfaceMeasures> surfaces;
   /// Of tables.
   std::vector<std::vector<std::string>> rigid_bodies;
   std::vector<std::vector<std::string>> ligaments;
   std::vector<std::vector<std::string>> joints;
   std::vector<PairAtStart> pairs;
   std::vector<TieAtStart> ties;
   std::vector<std::string> warnings;
   std::vector<std::string> hints;
   long long displacements = 0;
   long long pressures = 0;
   mfem::real_t gigabytes = 0.0;
};

} // namespace synovia
