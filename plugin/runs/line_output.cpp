#include "synovia/runs/line_output.hpp"
#include "synovia/general/error.hpp"

namespace synovia
{

LineOutput::LineOutput(const CaseFile &setup, BiphasicProblem &problem_)
   : directory(setup.output.directory + "/lines"), problem(problem_)
{
   CaseReading reading(setup.places);
   for (size_t i = 0; i < setup.output.lines.size(); i++)
   {
      reading.Catch("output.line." + std::to_string(i),
                    [&]() {
                       samplers.emplace_back(problem.Mesh(),
                                             setup.output.lines[i].line);
                    });
   }
   reading.ThrowIfAny();
}

void LineOutput::Write(const std::vector<size_t> &which, TimeStepper &stepper)
{
   if (which.empty())
   {
      return;
   }
   if (!stress)
   {
      stress = std::make_unique<StressRecovery>(problem.Spaces().Displacement(),
                                                problem.Materials(),
                                                problem.GetDeformation());
   }
   stress->Update(stepper.Displacement(), stepper.Pressure());
   std::vector<SampledField> fields = {
      {{"p"}, &stepper.Pressure()},
      {{"ux", "uy", "uz"}, &stepper.Displacement()},
      {{"sxx", "syy", "szz", "sxy", "syz", "sxz"}, &stress->Total()},
      {{"esxx", "esyy", "eszz", "esxy", "esyz", "esxz"}, &stress->Effective()}};
   if (problem.GetDeformation() == Deformation::finite)
   {
      if (!strains)
      {
         strains = std::make_unique<DeformationRecovery>(
            problem.Spaces().Displacement(), problem.Materials());
      }
      strains->Update(stepper.Displacement());
      fields.push_back({{"J"}, &strains->VolumeRatio()});
      fields.push_back({{"porosity"}, &strains->Porosity()});
      fields.push_back(
         {{"strain1", "strain2", "strain3"}, &strains->PrincipalStrain()});
   }
   for (const size_t i : which)
   {
      samplers[i].Write(directory, stepper.Time(), fields);
   }
}

} // namespace synovia
