#pragma once

#include "mfem.hpp"

namespace synovia
{

// Measured constants that decide how fast and how robustly problems are solved.
// Results depend on them within the tolerances only, but for the coverages and
// the bearing angle of contact, which decide about single vertices at the rim
// of a surface and at edges. The defaults were measured on the shipped cases;
// their keys in a case file are solver.tuning.GROUP.NAME.

/// Of the augmented Lagrangian of each contact pair.
struct ContactTuning
{
   /// Part of the area around a vertex of the destination that the source must
   /// cover for the vertex to be sealed. Larger: vertices at the rim of the
   /// source drain; smaller: they hold pressure against a free surface.
   mfem::real_t sealing_coverage = 0.75;
   /// Part of the area around a vertex of the source that sealed contact must
   /// cover for the vertex to be sealed.
   mfem::real_t source_sealing_coverage = 0.5;
   /// A vertex of the destination of which the source covers a smaller part
   /// bears no traction. Smaller: needles of traction at the rim.
   mfem::real_t least_coverage = 0.05;
   /// In finite deformation, a vertex of which the source covers a smaller part
   /// shares the multipliers of the vertices around. Smaller: needles of
   /// traction while vertices slide over the rim; larger: coarser multipliers
   /// along it.
   mfem::real_t rim_coverage = 0.4;
   /// In finite deformation, by how much larger an angle (radians) than where
   /// they face each other best around a vertex surfaces may turn away from
   /// each other, or the destination from itself there, and count wholly in its
   /// gap and bear its traction; where both are twice as large they don't at
   /// all. Larger: at rounded edges, gaps mix what touches with what never
   /// will, and the active set goes to and fro; above pi: all counts.
   mfem::real_t bearing_angle = 0.25;
   /// Part of a gap or jump that an augmentation may leave without the penalty
   /// being raised (Simo & Laursen, Comput Struct 42:97-116, 1992). Smaller:
   /// fewer augmentations with stiffer systems.
   mfem::real_t slow_augmentation = 0.25;
   /// Factor by which the penalty is raised then.
   mfem::real_t stiffening_factor = 10.0;
   /// Penalties are raised while they are less than this many times those at
   /// the start. Larger: round-off may keep Newton's method from converging.
   mfem::real_t largest_stiffening = 1e4;
   /// How far multipliers are extrapolated in time, in intervals between the
   /// last two states; from farther ahead the last ones are taken. 0: always.
   mfem::real_t prediction_reach = 1.5;
   /// In finite deformation, points that have gone to other faces are followed
   /// there within a solve if a gap of what touches nearly, or its area, would
   /// change by more than these parts: of the gap tolerance and of the gap
   /// itself, added, and of the area. Larger: fewer searches; the next step
   /// makes up for them.
   mfem::real_t drift_of_tolerance = 10.0;
   mfem::real_t drift_of_gap = 0.01;
   mfem::real_t drift_of_area = 0.02;
   /// Pairs that hardly slide keep what they have found of each other, unless
   /// they rub, until they have slid by this part of a face: in finite
   /// deformation if they slide by less in a time step, in infinitesimal strain
   /// if they look for each other as deformed. Larger: fewer sets and matrices
   /// that change, but areas of contact lag behind the motion by up to that. 0:
   /// each step looks anew.
   mfem::real_t kept_slide = 0.0;
};

/// Of Newton's method.
struct NewtonTuning
{
   /// The linear systems of finite deformation are solved to this part of the
   /// nonlinear residual at least. Larger: cheaper iterations, and more of
   /// them; what multigrid leaves may be all in what moves a rigid body, and
   /// the line search refuses steps of large increments.
   mfem::real_t largest_forcing = 1e-4;
   /// Of Eisenstat and Walker's forcing term, factor of the squared reduction
   /// of the residual in the last iteration.
   mfem::real_t forcing_factor = 0.9;
   /// Of the residual of a whole step, the part that is left of it by an
   /// iteration whose linear system is solved exactly; of smaller residuals, a
   /// smaller part in proportion. The first linear system of a step is solved
   /// as accurately.
   mfem::real_t curvature = 1e-3;
   /// What the linear systems of finite deformation may leave at most, in units
   /// of the nonlinear tolerance. Near 1, the last iteration may fail to reach
   /// it.
   mfem::real_t final_accuracy = 0.3;
   /// The linear systems of finite deformation close gaps, once the active set
   /// rests, as penalties would that are 1 over this times as large. Smaller:
   /// fewer Newton iterations, each of which takes more linear ones. 0: the
   /// penalties close them.
   mfem::real_t multiplier_compliance = 0.02;
   /// The last iterations of a solve keep the tangents of bodies and contact:
   /// those that leave at most this, in tolerances, if the residual falls as it
   /// did in the iteration before, where it fell by ten at least. None with
   /// friction. Larger: fewer tangents, but more iterations. 0: none does.
   mfem::real_t kept_tangent = 30.0;
   /// Smallest part of a step that the line search tries before the solve
   /// fails. Smaller: more evaluations before a time step is cut.
   mfem::real_t shortest_step = 1.0 / 16.0;
   /// Factor by which the residual may grow in a step. Larger: fewer shortened
   /// steps, but the iteration may diverge.
   mfem::real_t residual_growth = 2.0;
   /// With friction, a factor on it: what slides goes farther than the bodies'
   /// own increments.
   mfem::real_t sliding_growth = 10.0;
   /// Residuals below this many tolerances may always grow up to it.
   mfem::real_t residual_floor = 10.0;
   /// So may residuals below this part of the largest one of the solve: points
   /// that come into touch or leave it at last cost more than is left of the
   /// rest. Larger: fewer steps of time are cut for that, but what diverges
   /// near the end takes more iterations.
   mfem::real_t small_residual = 1e-4;
   /// How often the first system of a solve without a first guess is solved for
   /// other active sets: those to which it leads. Larger: a long first step
   /// distorts the bodies less where they come into contact.
   int max_first_sets = 4;
   /// What those systems leave of the residual, the last one apart. Smaller:
   /// more linear iterations for each set.
   mfem::real_t set_accuracy = 1e-2;
   /// How often contact is searched anew with a change of the active set.
   /// Larger: points near an edge may take the set to and fro with them.
   int max_early_searches = 10;
   /// How often contact is searched anew in one solve because points have moved
   /// on to other faces, once the active set has settled.
   int max_searches = 3;
   /// Part of the largest residual since the last search below which contact is
   /// searched anew, or the tolerance if that is more. Smaller: iterations are
   /// wasted on partners that change; larger: searches of what is still moving.
   mfem::real_t search_accuracy = 1e-3;
   /// A search is followed by another one if it upset the balance by less than
   /// this part of what the one before it did. Larger: points near an edge may
   /// go back and forth until max_searches.
   mfem::real_t search_reduction = 0.5;
};

/// Of factorizations that are kept over steps and active sets.
struct FactorizationTuning
{
   /// Unsymmetric matrices with more unknowns than compress_above, and
   /// symmetric ones with more than three times as many, are factorized with
   /// blocks of low rank of this accuracy. Larger: less time and memory for a
   /// factorization, and more iterations. 0: none are.
   mfem::real_t compression = 1e-4;
   int compress_above = 50000;
   /// Whether unsymmetric matrices, and symmetric ones with more unknowns than
   /// compress_above, are factorized in single precision, if MUMPS was built
   /// for it: half the time and memory. A system that fresh factors don't solve
   /// ends compression for good, and the next single precision.
   bool single_precision = true;
   /// Time steps within this factor of the one factorized for use its factors.
   /// Larger: fewer factorizations, more iterations.
   mfem::real_t like_step = 2.5;
   /// A contact weight that differs by more than this part of it gets a column
   /// of the low-rank update.
   mfem::real_t other_weight = 0.75;
   /// A column that differs by less than this part (of its norm) from the one
   /// that was solved for is not solved for again. Larger: fewer solves, more
   /// iterations in sliding contact.
   mfem::real_t like_column = 1e-2;
   /// Cost of a column among many relative to a solve of its own. With
   /// renew_after it decides when the factorization is renewed and how much
   /// memory columns may take.
   mfem::real_t column_cost = 0.1;
   /// How many columns are solved for at once: their right sides are gathered
   /// on one rank.
   int column_batch = 64;
   /// More columns than this lead to a new factorization: the dense part of the
   /// update would take longer than a solve.
   int max_columns = 1000;
   /// A solve with old factors that takes more iterations than this renews
   /// them.
   int stale_patience = 15;
   /// The same after a search has changed partners of contact.
   int moved_patience = 15;
};

/// Of block AMG, and of FGMRES around any preconditioner.
struct MultigridTuning
{
   /// Iterations after which FGMRES restarts; each keeps two vectors.
   int restart = 200;
   /// hypre's threshold of strong couplings in displacement. Larger: sparser
   /// operators on coarse levels, and more iterations.
   mfem::real_t strong_threshold = 0.25;
   /// Solids whose ModuliRatios::incompressibility is below this get one sweep
   /// of Gauss-Seidel each way, which takes half the time of MFEM's smoother
   /// for systems. Larger: the same for solids that it smooths slowly. 5 is
   /// that of a Poisson's ratio of 0.37.
   mfem::real_t smooth_incompressibility = 5.0;
   /// Displacements of elements whose ModuliRatios::anisotropy is above this
   /// are solved for exactly. Larger: multigrid smooths them, slowly.
   mfem::real_t smooth_anisotropy = 3.0;
   /// How many changed rows of contact the exact solves for displacements take
   /// as columns before they are factorized anew, while operators stay. Larger:
   /// fewer factorizations, but each solve takes longer.
   int max_filter_columns = 64;
   /// ModuliRatios::incompressibility (20 for a Poisson's ratio of 0.47) above
   /// which two V-cycles are made instead of one.
   mfem::real_t second_cycle = 20.0;
   /// Part of the undrained compliance in the Schur complement of the pressure:
   /// 1 where no solid can give way sideways, less the freer it is.
   mfem::real_t schur_compliance = 0.6;
   /// The hierarchy of the displacement is built anew when it has served for
   /// this many iterations and more than rebuild_change of the contact's
   /// weights are others.
   int rebuild_after = 25;
   mfem::real_t rebuild_change = 0.2;
   /// The same after a search has changed partners of contact, whatever the
   /// weights.
   int rebuild_after_sliding = 120;
   /// The hierarchies are built anew once changes of the tangent have cost more
   /// iterations than this.
   mfem::real_t rebuild_cost = 10.0;
};

/// Of the choice of time steps.
struct StepTuning
{
   /// Part of the error tolerance that adaptive steps aim at, as a factor of
   /// their length: a repeated step costs more than a short one.
   mfem::real_t safety = 0.9;
   /// Largest factor from one step to the next, and smallest one from a try to
   /// the next.
   mfem::real_t most_growth = 2.5;
   mfem::real_t most_cut = 0.02;
   /// A step is only lengthened by more than this factor: another length takes
   /// new matrices.
   mfem::real_t least_growth = 1.3;
   /// Steps don't grow after one with more Newton iterations a solve.
   mfem::real_t hard_newton = 20.0;
   /// How often a step is repeated because of its error.
   int max_rejections = 8;
};

struct SolverTuning
{
   ContactTuning contact;
   NewtonTuning newton;
   FactorizationTuning factorization;
   MultigridTuning multigrid;
   StepTuning steps;
};

} // namespace synovia
