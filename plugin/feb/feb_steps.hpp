#pragma once

#include "synovia/feb/feb_curves.hpp"
#include "synovia/time/time_stepper.hpp"

namespace synovia
{

/// How a model marches in time.
struct FebSteps
{
   /// The ends of the steps, from above 0.
   std::vector<mfem::real_t> ends;
   /// Of the steps, where all have the same.
   mfem::real_t length = 0.0;
   /// Whether nothing depends on what was before, such as stored fluid.
   bool steady = false;
   /// Steps from one output of fields to the next; 0: none.
   int fields_every = 1;

   TimeOptions Options() const;
};

/// Reads the section Control of a model of the module, solid or biphasic, or of
/// its step that begins at time @a begin. Where FEBio chooses the steps by its
/// iterations, these are the ones that it takes if every step converges well.
FebSteps ReadControl(const FebInput &section, const std::string &module,
                     const FebCurves &curves, mfem::real_t begin = 0.0);

} // namespace synovia
