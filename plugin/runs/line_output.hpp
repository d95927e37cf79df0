#pragma once

#include "synovia/cases/case_file.hpp"
#include "synovia/fem/deformation_recovery.hpp"
#include "synovia/fem/stress_recovery.hpp"
#include "synovia/io/line_sampler.hpp"
#include "synovia/time/time_stepper.hpp"

#include <memory>
#include <string>
#include <vector>

namespace synovia
{

/// The lines of a case: displacement, pressure, total and effective stress
/// along each, in lines/ of the output directory; in finite deformation also
/// the volume ratio J, the porosity and the principal logarithmic strains,
/// largest first.
class LineOutput
{
public:
   /// Borrows @a problem. Collective. Throws Error if a line leaves the mesh.
   LineOutput(const CaseFile &setup, BiphasicProblem &problem);

   /// Writes the lines with these numbers. Collective. Throws Error if that
   /// can't be done.
   void Write(const std::vector<size_t> &which, TimeStepper &stepper);

private:
   std::string directory;
   BiphasicProblem &problem;
   std::vector<LineSampler> samplers;
   /// Made when they are needed first, the latter in finite deformation.
   std::unique_ptr<StressRecovery> stress;
   std::unique_ptr<DeformationRecovery> strains;
};

} // namespace synovia
