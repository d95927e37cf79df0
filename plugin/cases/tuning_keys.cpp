#include "synovia/cases/tuning_keys.hpp"

namespace synovia
{

namespace
{
constexpr int most_iterations = 100000;

template <typename T>
void Add(KeyTable &keys, const std::string &name, T &value,
         const NumberRange &range, const std::string &meaning)
{
   keys.Value(name, value, "", meaning).In(range);
}

KeyTable ContactKeys(ContactTuning &contact)
{
   KeyTable keys;
   Add(keys, "sealing_coverage", contact.sealing_coverage,
       NumberRange::From(0.0, 1.0),
       "a destination vertex is sealed if the source covers more of it");
   Add(keys, "source_sealing_coverage", contact.source_sealing_coverage,
       NumberRange::From(0.0, 1.0),
       "a source vertex is sealed if sealed contact covers more of it");
   Add(keys, "least_coverage", contact.least_coverage,
       NumberRange::From(0.0, 1.0),
       "a destination vertex bears no traction if less is covered");
   Add(keys, "rim_coverage", contact.rim_coverage, NumberRange::From(0.0, 1.0),
       "in finite deformation, a vertex shares the multipliers around "
       "it if less is covered");
   Add(keys, "bearing_angle", contact.bearing_angle,
       NumberRange::Inside(0.0, 1e6),
       "in finite deformation, surfaces that turn away from each other by this "
       "angle more than elsewhere around a vertex begin to count less (rad)");
   Add(keys, "slow_augmentation", contact.slow_augmentation,
       NumberRange::Inside(0.0, 1.0),
       "part of a gap or jump that may be left without a larger penalty");
   Add(keys, "stiffening_factor", contact.stiffening_factor,
       NumberRange::From(1.0, 1e6), "factor by which penalties are raised");
   Add(keys, "largest_stiffening", contact.largest_stiffening,
       NumberRange::From(1.0, 1e12),
       "penalties beyond this many times the first ones are not raised");
   Add(keys, "prediction_reach", contact.prediction_reach,
       NumberRange::From(0.0, 100.0),
       "how far multipliers are extrapolated, in last intervals");
   Add(keys, "drift_of_tolerance", contact.drift_of_tolerance,
       NumberRange::AtLeast(0.0),
       "in finite deformation, change of a gap up to which no new search is "
       "followed within a solve, in gap tolerances");
   Add(keys, "drift_of_gap", contact.drift_of_gap, NumberRange::AtLeast(0.0),
       "part of the gap that is added to it");
   Add(keys, "drift_of_area", contact.drift_of_area, NumberRange::AtLeast(0.0),
       "the same for the area around a vertex, as a part of it");
   Add(keys, "kept_slide", contact.kept_slide, NumberRange::AtLeast(0.0),
       "parts of a face that pairs without friction slide before they look for "
       "partners anew, in infinitesimal strain those of the current "
       "configuration");
   return keys;
}

KeyTable NewtonKeys(NewtonTuning &newton)
{
   KeyTable keys;
   Add(keys, "largest_forcing", newton.largest_forcing,
       NumberRange::Inside(0.0, 1.0),
       "part of the nonlinear residual that linear systems may leave");
   Add(keys, "forcing_factor", newton.forcing_factor,
       NumberRange::Inside(0.0, 10.0),
       "factor of Eisenstat and Walker's forcing term");
   Add(keys, "curvature", newton.curvature, NumberRange::From(0.0, 1.0),
       "what the first iteration leaves of a whole step's residual");
   Add(keys, "final_accuracy", newton.final_accuracy,
       NumberRange::Inside(0.0, 1.0),
       "what linear systems may leave in the end, in tolerances");
   Add(keys, "multiplier_compliance", newton.multiplier_compliance,
       NumberRange::AtLeast(0.0),
       "over this, penalties close gaps in the linear systems");
   Add(keys, "kept_tangent", newton.kept_tangent, NumberRange::From(0.0, 1e6),
       "what an iteration with the last tangent may be expected to leave, in "
       "tolerances; 0: all take new ones");
   Add(keys, "shortest_step", newton.shortest_step,
       NumberRange::Inside(0.0, 1.0),
       "smallest part of a step that the line search tries");
   Add(keys, "residual_growth", newton.residual_growth,
       NumberRange::From(1.0, 1e6),
       "factor by which the residual may grow in a step");
   Add(keys, "sliding_growth", newton.sliding_growth,
       NumberRange::From(1.0, 1e6), "factor on it where there is friction");
   Add(keys, "residual_floor", newton.residual_floor,
       NumberRange::From(1.0, 1e6),
       "residual up to which it may always grow, in tolerances");
   Add(keys, "small_residual", newton.small_residual,
       NumberRange::From(0.0, 1.0),
       "the same, as a part of the solve's largest residual");
   Add(keys, "max_first_sets", newton.max_first_sets,
       NumberRange::From(0, 1000),
       "most active sets for which the first system of a solve without a "
       "guess is solved");
   Add(keys, "set_accuracy", newton.set_accuracy, NumberRange::Inside(0.0, 1.0),
       "part of the residual that these systems but the last may leave");
   Add(keys, "max_early_searches", newton.max_early_searches,
       NumberRange::From(0, 1000),
       "most new searches of contact while the active set changes");
   Add(keys, "max_searches", newton.max_searches, NumberRange::From(0, 1000),
       "most new searches of contact in one solve");
   Add(
      keys, "search_accuracy", newton.search_accuracy,
      NumberRange::From(0.0, 1.0),
      "part of the residual since the last search at which contact is searched "
      "anew");
   Add(keys, "search_reduction", newton.search_reduction,
       NumberRange::Inside(0.0, 1.0),
       "part of the last search's residual that one more search may cause");
   return keys;
}

KeyTable FactorizationKeys(FactorizationTuning &factorization)
{
   KeyTable keys;
   Add(keys, "compression", factorization.compression,
       NumberRange::From(0.0, 1.0),
       "accuracy of blocks of low rank in unsymmetric factors; 0: none");
   Add(keys, "compress_above", factorization.compress_above,
       NumberRange::From(0, 1000000000),
       "unknowns above which unsymmetric factors are compressed");
   keys.Value("single_precision", factorization.single_precision, "",
              "whether unsymmetric matrices are factorized in single "
              "precision");
   Add(keys, "like_step", factorization.like_step, NumberRange::From(1.0, 1e6),
       "factor of time steps that may share a factorization");
   Add(keys, "other_weight", factorization.other_weight,
       NumberRange::Inside(0.0, 1.0),
       "relative change of a contact weight that makes a column");
   Add(keys, "like_column", factorization.like_column,
       NumberRange::Inside(0.0, 1.0),
       "relative change of a column up to which its solution serves");
   Add(keys, "column_cost", factorization.column_cost,
       NumberRange::From(1e-3, 10.0), "cost of a column in solves");
   Add(keys, "column_batch", factorization.column_batch,
       NumberRange::From(1, 10000), "how many columns are solved for at once");
   Add(keys, "max_columns", factorization.max_columns,
       NumberRange::From(0, most_iterations),
       "most columns of the low-rank update");
   Add(keys, "stale_patience", factorization.stale_patience,
       NumberRange::From(1, most_iterations),
       "most iterations with an old factorization");
   Add(keys, "moved_patience", factorization.moved_patience,
       NumberRange::From(1, most_iterations),
       "the same after a search of contact");
   return keys;
}

KeyTable MultigridKeys(MultigridTuning &multigrid)
{
   KeyTable keys;
   Add(keys, "restart", multigrid.restart,
       NumberRange::From(2, most_iterations),
       "iterations after which FGMRES restarts");
   Add(keys, "strong_threshold", multigrid.strong_threshold,
       NumberRange::Inside(0.0, 1.0),
       "of BoomerAMG's strong couplings of displacements");
   Add(keys, "smooth_incompressibility", multigrid.smooth_incompressibility,
       NumberRange::AtLeast(0.0),
       "H_A/G below which one sweep each way smooths");
   Add(keys, "smooth_anisotropy", multigrid.smooth_anisotropy,
       NumberRange::AtLeast(0.0),
       "anisotropy above which displacements are solved for exactly");
   Add(keys, "max_filter_columns", multigrid.max_filter_columns,
       NumberRange::From(0, most_iterations),
       "most changed contacts that the exact solves take as columns");
   Add(keys, "second_cycle", multigrid.second_cycle, NumberRange::AtLeast(0.0),
       "H_A/G above which two V-cycles are made");
   Add(keys, "schur_compliance", multigrid.schur_compliance,
       NumberRange::From(0.0, 1.0),
       "part of M/H_A in the pressure's Schur complement");
   Add(keys, "rebuild_after", multigrid.rebuild_after,
       NumberRange::From(0, most_iterations),
       "iterations that a hierarchy serves at least");
   Add(keys, "rebuild_change", multigrid.rebuild_change,
       NumberRange::From(0.0, 2.0),
       "part of the contact weights whose change makes a new hierarchy");
   Add(keys, "rebuild_after_sliding", multigrid.rebuild_after_sliding,
       NumberRange::From(0, most_iterations),
       "iterations after which a search makes a new hierarchy");
   Add(keys, "rebuild_cost", multigrid.rebuild_cost, NumberRange::AtLeast(0.0),
       "iterations lost to changes of the tangent that make new "
       "hierarchies");
   return keys;
}

KeyTable StepKeys(StepTuning &steps)
{
   KeyTable keys;
   Add(keys, "safety", steps.safety, NumberRange::From(0.1, 1.0),
       "factor of the step that the error tolerance allows");
   Add(keys, "most_growth", steps.most_growth, NumberRange::From(1.0, 1000.0),
       "largest factor from one step to the next");
   Add(keys, "most_cut", steps.most_cut, NumberRange::From(1e-6, 0.1),
       "smallest factor from one try to the next");
   Add(keys, "least_growth", steps.least_growth, NumberRange::From(1.0, 1000.0),
       "smallest factor for which a step is lengthened");
   Add(keys, "hard_newton", steps.hard_newton, NumberRange::AtLeast(1.0),
       "Newton iterations a solve above which steps don't grow");
   Add(keys, "max_rejections", steps.max_rejections, NumberRange::From(0, 1000),
       "how often a step is repeated because of its error");
   return keys;
}
} // namespace

KeyTable TuningKeys(SolverTuning &tuning)
{
   KeyTable keys;
   keys.Table("contact", ContactKeys(tuning.contact), "");
   keys.Table("newton", NewtonKeys(tuning.newton), "");
   keys.Table("factorization", FactorizationKeys(tuning.factorization), "");
   keys.Table("multigrid", MultigridKeys(tuning.multigrid), "");
   keys.Table("steps", StepKeys(tuning.steps), "");
   return keys;
}

} // namespace synovia
