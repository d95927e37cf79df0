#pragma once

#include "synovia/general/solver_tuning.hpp"
#include "synovia/general/state_archive.hpp"

namespace synovia
{

/// Bounds of the step length, and how it is chosen.
struct StepLimits
{
   mfem::real_t first = 1.0;
   mfem::real_t shortest = 1e-3;
   mfem::real_t longest = 1.0;
   /// Otherwise steps have the first length or the one planned, but for those
   /// that fail.
   bool adaptive = false;
   /// Whether a step that fails is tried again with a shorter one.
   bool cut_back = true;
   /// Largest relative error of a step.
   mfem::real_t tolerance = 1e-2;
};

/// Result of one attempt at a step.
struct StepAttempt
{
   mfem::real_t dt = 0.0;
   /// Estimated error, relative, that goes with the power @a order of dt.
   mfem::real_t error = 0.0;
   int order = 2;
   /// Newton iterations for one implicit solve.
   mfem::real_t newton = 0.0;
};

/// Decides the length of the next step from how the last ones went.
///
/// Cuts a step that fails in half; makes an adaptive step as long as its error
/// allows, and less where it is hard to solve. Where a shorter step has no
/// smaller error, something jumps in it, such as a node that comes into
/// contact, and it is accepted as it is. Plain arithmetic: given the same, all
/// ranks decide the same.
class StepControl
{
public:
   explicit StepControl(const StepLimits &limits,
                        const StepTuning &tuning = StepTuning());

   /// Longest length of the next attempt.
   mfem::real_t Length() const { return length; }
   const StepLimits &Limits() const { return limits; }

   /// How long the next step shall be if it is not cut; adaptive ones don't
   /// care.
   void Plan(mfem::real_t planned);
   /// Whether attempts are shorter than planned, as one has failed.
   bool IsCut() const { return !limits.adaptive && length < limits.first; }

   /// An attempt of length @a dt did not converge. False if it must not be
   /// shorter.
   bool Fail(mfem::real_t dt);

   enum class Verdict
   {
      accept,
      /// The error is not one that a shorter step would mend.
      accept_jump,
      repeat
   };
   /// An attempt converged.
   Verdict Judge(const StepAttempt &step);
   /// It was accepted: the next one may be longer.
   void Grow(const StepAttempt &step);

   void Archive(StateArchive &archive);

private:
   StepLimits limits;
   StepTuning tuning;
   mfem::real_t length;
   /// Of the attempts at the present step.
   int failures = 0;
   int rejections = 0;
   mfem::real_t rejected_dt = 0.0;
   mfem::real_t rejected_error = 0.0;
};

} // namespace synovia
