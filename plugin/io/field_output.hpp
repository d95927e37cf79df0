#pragma once

#include "synovia/fem/stress_recovery.hpp"
#include "synovia/io/paraview_output.hpp"
#include "synovia/time/time_stepper.hpp"

#include <memory>
#include <string>
#include <vector>

namespace synovia
{

/// The fields of a problem for ParaView, below `<directory>/fields`.
///
/// bodies: displacement, velocity, fluid_pressure, relative_flux, total_stress,
/// effective_stress, principal_stress (total, largest first), region; in finite
/// deformation also principal_strain (logarithmic, largest first),
/// volume_ratio, porosity, and largest_stress_direction and
/// smallest_stress_direction of the total stress. Stresses and relative flux
/// are those in space: per current area.
/// `contact_<pair>`: contact_pressure, gap, contact_status, friction, sliding
/// on the destination.
class FieldOutput
{
public:
   /// Borrows @a problem and @a stepper. Collective. Throws Error if the
   /// directory can't be written. @a append keeps the steps of an earlier run
   /// that lie before the first one saved here.
   FieldOutput(const std::string &directory, BiphasicProblem &problem,
               TimeStepper &stepper, bool append = false);
   ~FieldOutput();

   /// Brings the derived fields up to the stepper's state. Collective.
   void Update();
   /// Updates and writes, once in a step. Collective.
   void Save();

   /// Nodal averages, as of the last Update().
   StressRecovery &Stress() { return stress; }

private:
   class Surface;
   class Strains;

   BiphasicProblem &problem;
   TimeStepper &stepper;
   StressRecovery stress;
   mfem::ParFiniteElementSpace flux_space;
   mfem::ParGridFunction velocity;
   mfem::ParGridFunction flux;
   ParaViewOutput bodies;
   /// In finite deformation.
   std::unique_ptr<Strains> strains;
   std::vector<std::unique_ptr<Surface>> surfaces;
};

} // namespace synovia
