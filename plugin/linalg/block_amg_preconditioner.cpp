#include "synovia/linalg/block_amg_preconditioner.hpp"
#include "synovia/general/profiled_work.hpp"
#include "synovia/general/reduce.hpp"
#include "synovia/general/vector_entries.hpp"

#include <algorithm>
#include <cmath>

namespace synovia
{

using namespace mfem;

namespace
{
bool Same(const Vector &a, const Vector &b)
{
   if (a.Size() != b.Size())
   {
      return false;
   }
   for (int i = 0; i < a.Size(); i++)
   {
      if (a[i] != b[i])
      {
         return false;
      }
   }
   return true;
}

// Takes the pairs' weights into @a kept and says whether any rank's changed.
template <typename GetWeights>
bool TakeWeights(const ContactTerms &pairs, MPI_Comm comm,
                 std::vector<Vector> &kept, GetWeights weights)
{
   kept.resize(pairs.size());
   bool changed = false;
   for (size_t i = 0; i < pairs.size(); i++)
   {
      const Vector &now = weights(pairs[i]);
      if (!Same(kept[i], now))
      {
         kept[i] = now;
         changed = true;
      }
   }
   return AnyRank(changed, comm);
}

FilteredAmg::Factors Gaps(const ContactTerms &pairs)
{
   FilteredAmg::Factors gaps;
   for (const ContactFactors &pair : pairs)
   {
      gaps.push_back({pair.gap, pair.gap_change});
   }
   return gaps;
}

FilteredAmg::Factors Jumps(const ContactTerms &pairs)
{
   FilteredAmg::Factors jumps;
   for (const ContactFactors &pair : pairs)
   {
      jumps.push_back({pair.jump, pair.jump});
   }
   return jumps;
}

// Aggressive coarsening, MFEM's default, costs more iterations than it saves
// time on each.
std::unique_ptr<HypreBoomerAMG> FlowAmg()
{
   auto amg = std::make_unique<HypreBoomerAMG>();
   amg->SetAggressiveCoarsening(0);
   return amg;
}

// Measured with miniapps/scaling: half the time of an iteration of MFEM's
// options for systems, for a tenth more iterations.
void SmoothOnceEachWay(HypreBoomerAMG &amg, const VolumeMatrices &matrices,
                       real_t strong_threshold)
{
   constexpr int down = 1;
   constexpr int up = 2;
   constexpr int by_row_sum_norm = 4;
   // On each rank; l1 enlarges diagonals by couplings between ranks. With it
   // order 1 takes a tenth more iterations on 64 ranks; without it order 3 on
   // tetrahedra takes a third more on 8, and layers compressed by 30 % take a
   // twentieth more on 2.
   constexpr int gauss_seidel = 3;
   constexpr int gauss_seidel_l1 = 13;
   const int forward = matrices.order == 1 && matrices.symmetric
                          ? gauss_seidel
                          : gauss_seidel_l1;
   const int backward = forward + 1;
   HYPRE_Solver hypre = amg;
   HYPRE_BoomerAMGSetCycleRelaxType(hypre, forward, down);
   HYPRE_BoomerAMGSetCycleRelaxType(hypre, backward, up);
   if (!matrices.tetrahedra)
   {
      // A sixth less time on hexahedra; on tetrahedra of order 3 nearly twice
      // the iterations.
      HYPRE_BoomerAMGSetNodal(hypre, by_row_sum_norm);
      HYPRE_BoomerAMGSetNodalDiag(hypre, 1);
   }
   HYPRE_BoomerAMGSetStrongThreshold(hypre, strong_threshold);
}

bool SmoothsWell(const ModuliRatios &moduli, const MultigridTuning &tuning)
{
   return moduli.incompressibility < tuning.smooth_incompressibility;
}

// Displacements that the smoother hardly moves across fibers.
Array<int> AnisotropicDofs(const Vector &anisotropy,
                           const MultigridTuning &tuning)
{
   Array<int> dofs;
   for (int i = 0; i < anisotropy.Size(); i++)
   {
      if (anisotropy[i] > tuning.smooth_anisotropy)
      {
         dofs.Append(i);
      }
   }
   return dofs;
}

// Without overlap the filter has half the dofs to solve for, which saves a
// sixth of the time; but the smoother must be good near the contact, or there
// are half as many iterations more: in order 2 it is in infinitesimal strain.
int Overlap(const VolumeMatrices &matrices, const MultigridTuning &tuning)
{
   const int most_order = matrices.symmetric ? 2 : 1;
   return SmoothsWell(matrices.moduli, tuning) && matrices.order <= most_order
             ? 0
             : 1;
}

std::unique_ptr<HypreBoomerAMG> ElasticityAmg(const VolumeMatrices &matrices,
                                              const MultigridTuning &tuning)
{
   std::unique_ptr<HypreBoomerAMG> amg = FlowAmg();
   amg->SetSystemsOptions(3, false);
   // The smoother works slowly on what keeps the volume: more of it is less
   // work in all then, and two V-cycles where the solid hardly gives way (30
   // iterations instead of 45).
   if (SmoothsWell(matrices.moduli, tuning))
   {
      SmoothOnceEachWay(*amg, matrices, tuning.strong_threshold);
   }
   else if (matrices.moduli.incompressibility > tuning.second_cycle)
   {
      amg->SetMaxIter(2);
   }
   return amg;
}
} // namespace

BlockAmgPreconditioner::BlockAmgPreconditioner(
   const BiphasicJacobian &jacobian_, MPI_Comm comm_,
   const DirectOptions &options_, const MultigridTuning &tuning_)
   : BiphasicPreconditioner(jacobian_.Height()), jacobian(jacobian_),
     comm(comm_), options(options_), tuning(tuning_),
     // Under a load, the stiffness of bodies of finite deformation need not be
     // definite.
     kind(jacobian.Volume().symmetric ? MatrixKind::positive_definite
                                      : MatrixKind::symmetric)
{
   const Array<int> exact =
      AnisotropicDofs(jacobian.Volume().anisotropy, tuning);
   // Between bodies that only multigrid solves for, filters are small.
   options.single_precision =
      options.single_precision && AnyRank(exact.Size() > 0, comm);
   // Exact solves around the V-cycle would save no iterations on a knee in
   // finite deformation, and an eighth in infinitesimal, but take a fourth more
   // time for each. Without the pressure's second ones it would be a seventh
   // more iterations.
   displacement = std::make_unique<FilteredAmg>(
      jacobian.StiffnessUnderTraction(), jacobian.DisplacementDofs(), exact,
      Overlap(jacobian.Volume(), tuning), FilteredAmg::Filter::before, kind,
      options, tuning.max_filter_columns);
}

void BlockAmgPreconditioner::TangentChanged()
{
   tangent_changed = true;
}

void BlockAmgPreconditioner::FollowTangent()
{
   if (extra_iterations > tuning.rebuild_cost)
   {
      built = false;
      moved = true;
      pressure.reset();
   }
   tangent_changed = false;
}

void BlockAmgPreconditioner::ContactMoved()
{
   moved = true;
}

void BlockAmgPreconditioner::Update()
{
   // What is solved for exactly follows each tangent, as old derivatives of
   // contact tractions can take a hundred iterations.
   const bool entries_changed = moved || tangent_changed;
   if (tangent_changed)
   {
      FollowTangent();
   }
   const bool gaps_changed =
      TakeWeights(jacobian.Contact(), comm, gap_weights,
                  [](const ContactFactors &pair) -> const Vector &
                  { return *pair.gap_weights; });
   const bool jumps_changed =
      TakeWeights(jacobian.Contact(), comm, jump_weights,
                  [](const ContactFactors &pair) -> const Vector &
                  { return *pair.jump_weights; });
   UpdateDisplacement(gaps_changed, entries_changed);
   UpdatePressure(jumps_changed);
   moved = false;
}

std::vector<Vector> BlockAmgPreconditioner::SoftWeights() const
{
   std::vector<Vector> weights;
   for (const ContactFactors &pair : jacobian.Contact())
   {
      weights.emplace_back(*pair.gap_weights);
      Vector &soft = weights.back();
      for (int j = 0; j < soft.Size(); j++)
      {
         soft[j] = std::min(soft[j], (*pair.gap_resistance)[j]);
      }
   }
   return weights;
}

bool BlockAmgPreconditioner::IsOutdated() const
{
   if (served < tuning.rebuild_after)
   {
      return false;
   }
   if (moved && served >= tuning.rebuild_after_sliding)
   {
      return true;
   }
   const std::vector<Vector> now = SoftWeights();
   real_t difference = 0.0;
   real_t sum = 0.0;
   for (size_t i = 0; i < now.size(); i++)
   {
      Vector change(now[i]);
      change -= soft_weights[i];
      difference += change.Norml1();
      sum += now[i].Norml1();
   }
   return SumOverRanks(difference, comm) >
          tuning.rebuild_change * SumOverRanks(sum, comm);
}

void BlockAmgPreconditioner::BuildHierarchy()
{
   soft_weights = SoftWeights();
   displacement->ClearHierarchy();
   displacement->SetHierarchy(jacobian.DisplacementBlock(soft_weights),
                              ElasticityAmg(jacobian.Volume(), tuning));
   built = true;
   served = 0;
   fresh_rate = 0.0;
   extra_iterations = 0.0;
   work.setups++;
}

bool BlockAmgPreconditioner::Report(const SolveAttempt &attempt)
{
   served += attempt.iterations;
   const real_t tenths = -std::log10(attempt.reduction);
   if (tenths > 0.0 && fresh_rate == 0.0)
   {
      fresh_rate = attempt.iterations / tenths;
   }
   else if (tenths > 0.0)
   {
      extra_iterations += attempt.iterations - fresh_rate * tenths;
   }
   improved = !attempt.converged && Improve();
   return improved;
}

bool BlockAmgPreconditioner::Improve()
{
   const bool displacement_improved = displacement->Improve();
   const bool pressure_improved = pressure->Improve();
   // Those to come, too.
   options.single_precision = options.single_precision && !pressure_improved;
   return displacement_improved || pressure_improved;
}

void BlockAmgPreconditioner::UpdateDisplacement(bool gaps_changed,
                                                bool entries_changed)
{
   if (!built || ((moved || gaps_changed) && IsOutdated()))
   {
      BuildHierarchy();
   }
   if (entries_changed)
   {
      displacement->SetFactors(Gaps(jacobian.Contact()));
   }
   if (entries_changed || gaps_changed || improved)
   {
      displacement->Replace(jacobian.StiffnessUnderTraction(),
                            Gaps(jacobian.Contact()));
      displacement->SetWeights(gap_weights, soft_weights, work);
   }
}

void BlockAmgPreconditioner::UpdatePressure(bool jumps_changed)
{
   // Where surfaces can touch, what drains changes with the contact, and the
   // filter takes care of it.
   if (moved)
   {
      touched =
         FilteredAmg::Touched(jacobian.Offsets()[2] - jacobian.Offsets()[1],
                              Jumps(jacobian.Contact()));
   }
   Array<int> always_drained;
   Array<int> drained;
   for (const int dof : jacobian.PressureDofs())
   {
      (touched[dof] ? drained : always_drained).Append(dof);
   }
   const bool drains_elsewhere = AnyRank(!(p_dofs == always_drained), comm);
   // Steps that end on a corner differ by round-off.
   const bool other_step =
      std::abs(dt - jacobian.TimeStep()) > 1e-6 * jacobian.TimeStep();
   const bool other_matrix = !pressure || drains_elsewhere || other_step;
   const bool other_drained = AnyRank(!(held == drained), comm);
   if (other_matrix)
   {
      dt = jacobian.TimeStep();
      p_dofs = always_drained;
      pressure.reset();
      schur = jacobian.SchurComplement(p_dofs, tuning.schur_compliance);
      pressure = std::make_unique<FilteredAmg>(
         FilteredAmg::Matrices{schur.get()}, p_dofs, Array<int>(), 1,
         FilteredAmg::Filter::around, MatrixKind::positive_definite, options,
         0);
      pressure->SetHierarchy(std::make_unique<HypreParMatrix>(*schur),
                             FlowAmg());
      work.setups++;
   }
   if (moved || other_matrix)
   {
      pressure->SetFactors(Jumps(jacobian.Contact()));
   }
   if (moved || other_matrix || other_drained || jumps_changed || improved)
   {
      held = drained;
      pressure->Replace({schur.get()}, Jumps(jacobian.Contact()));
      pressure->SetHeld(held);
      std::vector<Vector> weights(jump_weights);
      for (Vector &w : weights)
      {
         w *= dt;
      }
      pressure->SetWeights(weights, {}, work);
   }
}

void BlockAmgPreconditioner::Mult(const Vector &x, Vector &y) const
{
   const Array<int> &offsets = jacobian.Offsets();
   const int nu = offsets[1];
   const int np = offsets[2] - nu;
   x.Read();
   y.Write();
   const Vector x_u(const_cast<Vector &>(x), 0, nu);
   const Vector x_p(const_cast<Vector &>(x), nu, np);
   Vector y_u(y, 0, nu);
   Vector y_p(y, nu, np);

   {
      const ProfiledWork work_u("displacement", 0.0);
      displacement->Mult(x_u, y_u);
   }
   u_free = y_u;
   u_free.SetSubVector(jacobian.DisplacementDofs(), 0.0);
   residual = x_p;
   jacobian.AddMassOfDisplacement(u_free, residual);
   residual.Neg();
   CopyEntries(jacobian.PressureDofs(), x_p, residual);
   {
      const ProfiledWork work_p("pressure", 0.0);
      pressure->Mult(residual, y_p);
   }
   y_u.SyncAliasMemory(y);
   y_p.SyncAliasMemory(y);
}

} // namespace synovia
