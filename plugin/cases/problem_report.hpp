#pragma once

#include "cases/case_problem.hpp"
#include "cases/contact_check.hpp"

#include <iosfwd>
#include <limits>
#include <string>
#include <vector>

namespace synovia
{

/// What there is to know about a case before it runs: regions, surfaces,
/// materials, pairs, unknowns, and what looks like a mistake.
class ProblemReport
{
public:
   /// Collective. Throws Error if a contact pair can't be, or if a material's
   /// stiffness isn't positive definite.
   ProblemReport(const CaseFile &setup, CaseProblem &problem);

   /// Writes it for people to read.
   void Write(std::ostream &out) const;

   /// What looks like a mistake, a sentence each.
   const std::vector<std::string> &Warnings() const { return warnings; }

   /// What one region is and is made of.
   struct Region
   {
      std::string name;
      long long elements = 0;
      mfem::real_t volume = 0.0;
      /// Scaled Jacobian of the worst element.
      mfem::real_t quality = std::numeric_limits<mfem::real_t>::infinity();
      mfem::real_t aggregate_modulus = 0.0;
      /// Of the stiffness, as a map of strain tensors to stress tensors.
      mfem::real_t least_eigenvalue =
         std::numeric_limits<mfem::real_t>::infinity();
      mfem::real_t largest_eigenvalue = 0.0;
      mfem::real_t permeability = 0.0;
      /// Volume over the area from which it drains; 0 if there is none.
      mfem::real_t thickness = 0.0;
      /// thickness^2 / (H_A kappa)
      mfem::real_t gel_time = 0.0;
   };
   const std::vector<Region> &Regions() const { return regions; }

   struct Surface
   {
      std::string name;
      long long faces = 0;
      mfem::real_t area = 0.0;
   };
   const std::vector<Surface> &Surfaces() const { return surfaces; }

private:
   void MeasureRegions(const CaseFile &setup, CaseProblem &problem);
   void MeasureSurfaces(const NamedMesh &mesh);
   void Count(const CaseFile &setup, CaseProblem &problem);
   void WarnOfTimes(const CaseFile &setup);
   void WarnOfBodies(const CaseFile &setup, CaseProblem &problem);
   void VerifyStiffness(const CaseFile &setup, const NamedMesh &mesh) const;

   std::string title;
   int ranks = 1;
   int order = 2;
   std::vector<Region> regions;
   std::vector<Surface> surfaces;
   std::vector<PairAtStart> pairs;
   long long displacements = 0;
   long long pressures = 0;
   mfem::real_t gigabytes = 0.0;
   std::vector<std::string> warnings;
};

} // namespace synovia
