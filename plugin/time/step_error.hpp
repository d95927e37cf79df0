#pragma once

#include "synovia/fem/volume_matrices.hpp"
#include "synovia/time/stage_recorder.hpp"

namespace synovia
{

/// Schemes that are L-stable and stiffly accurate.
enum class TimeScheme
{
   backward_euler,
   sdirk23,
   sdirk33
};

/// Order of convergence.
int Order(TimeScheme scheme);

/// The energy norm of a state (u, p):
///
///     |(u, p)|^2 = (C eps(u), eps(u)) + (p / H_A, p)
///
/// It is an energy in every system of units, blind to (infinitesimal) rigid
/// motion, and measures the strains and the pressure of which stresses are
/// made.
class EnergyNorm
{
public:
   /// Shares the matrices of the undeformed bodies, which must be those now:
   /// where bodies change them they make others. Borrows @a offsets.
   EnergyNorm(const VolumeMatrices &matrices, const mfem::Array<int> &offsets);
   /// Collective; @a x are true dofs.
   mfem::real_t operator()(const mfem::Vector &x) const;

private:
   std::shared_ptr<const mfem::HypreParMatrix> stiffness;
   std::shared_ptr<const mfem::HypreParMatrix> compliance;
   const mfem::Array<int> &offsets;
};

/// The rate (v, dp/dt) with which the step before ended, and over what length
/// it was found.
struct PastRate
{
   const mfem::Vector &rate;
   mfem::real_t dt;
};

/// An estimate of the error that one step of length @a dt made, as a state,
/// from the rates of its stages, good where the rates are smooth.
///
/// Backward Euler: dt^2 u''/2, with u'' from the rates of this step and the one
/// before (k and k0): dt^2 (k - k0) / (dt + dt0). The others compare with the
/// solution one order lower that their stages give as well.
mfem::Vector EstimateError(TimeScheme scheme, const StageRecorder &stages,
                           mfem::real_t dt, const PastRate &past);
/// Its order in dt.
int EstimateOrder(TimeScheme scheme);

} // namespace synovia
