#pragma once

#include "synovia/fem/strain_monitor.hpp"
#include "synovia/io/history.hpp"
#include "synovia/time/time_stepper.hpp"

namespace synovia
{

/// One row of the history for the step just accepted:
///
///     t, dt
///     reaction.<boundary>.x|y|z        force of the support on the body
///     spring.<boundary>.x|y|z          force of all its springs on the body
///     contact.<pair>.force_x|y|z       on the destination
///     contact.<pair>.source_force_x|y|z, .force_error (both sides' sum)
///     contact.<pair>.area, .penetration, .pressure_jump, .peak_traction,
///     .peak_pressure (of the destination's sealed vertices),
///     .fluid_exchange (volume / time, from source to destination)
///     contact.<pair>.friction_x|y|z (part of force), .friction_coefficient
///     (friction over normal force), .sliding (part of the area in contact),
///     .dissipation (work since the start): of pairs with friction
///     tie.<name>.force_x|y|z, .moment_x|y|z (on the destination, about the
///     origin), .force_error, .moment_error (both sides' sum),
///     .displacement_jump, .pressure_jump, .fluid_exchange (the last two where
///     both sides have fluid)
///     fluid.growth, fluid.outflow (volume / time), fluid.supply (likewise,
///     where vessels let fluid in), fluid.volume_balance (growth + outflow -
///     supply), fluid.peak_pressure
///     solver.newton, .augmentations, .linear, .most_linear
///     solver.assemblies, .searches, .setups, .factorizations, .columns (see
///     WorkCounts; of all tries)
///     solver.seconds
///
/// Collective.
History::Row StepDiagnostics(BiphasicProblem &problem, TimeStepper &stepper,
                             const StepReport &report);

/// Adds strain.max_principal and strain.min_det_F.
void AddStrains(History::Row &row, const StrainExtremes &strains);

} // namespace synovia
