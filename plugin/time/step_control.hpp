#pragma once

#include "synovia/general/solver_tuning.hpp"
#include "synovia/general/state_archive.hpp"

namespace synovia
{

/// Between what lengths steps are chosen, and how.
struct StepLimits
{
   mfem::real_t first = 1.0;
   mfem::real_t shortest = 1e-3;
   mfem::real_t longest = 1.0;
   /// Otherwise steps have the first length, but for those that fail.
   bool adaptive = false;
   /// Whether a step that fails is tried again with a shorter one.
   bool cut_back = true;
   /// What the relative error of a step may be.
   mfem::real_t tolerance = 1e-2;
};

/// What a try of a step came to.
struct StepTry
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

   /// How long the next try should be at most.
   mfem::real_t Length() const { return length; }
   const StepLimits &Limits() const { return limits; }

   /// A try of length @a dt did not converge. False if it must not be shorter.
   bool Fail(mfem::real_t dt);

   enum class Verdict
   {
      accept,
      /// The error is not one that a shorter step would mend.
      accept_jump,
      repeat
   };
   /// A try converged.
   Verdict Judge(const StepTry &step);
   /// It was accepted: the next one may be longer.
   void Grow(const StepTry &step);

   void Archive(StateArchive &archive);

private:
   StepLimits limits;
   StepTuning tuning;
   mfem::real_t length;
   /// Of the tries of the present step.
   int failures = 0;
   int rejections = 0;
   mfem::real_t rejected_dt = 0.0;
   mfem::real_t rejected_error = 0.0;
};

} // namespace synovia
