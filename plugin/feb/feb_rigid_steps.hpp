#pragma once

#include "synovia/feb/feb_model.hpp"

namespace synovia
{

/// How rigid bodies move from step to step: as the model says without steps,
/// and as each step adds for as long as it lasts. What a step fixes stays where
/// the step before it ended.
class FebRigidSteps
{
public:
   /// The bodies of @a model, before the first step.
   explicit FebRigidSteps(const FebModel &model);

   /// Reads what the section Rigid of a step says, which lasts from @a begin to
   /// @a end, beside what other sections have said to the bodies of @a model,
   /// and gives these back to the next step. Times of the bodies that it
   /// returns count from @a begin. What can't be stops the import.
   std::vector<RigidBodyCase> Next(const FebInput &step, mfem::real_t begin,
                                   mfem::real_t end, FebModel &model);

private:
   /// By freedom, translations first.
   using Places = std::array<std::optional<mfem::real_t>, 6>;

   std::vector<RigidBodyCase> bodies;
   /// Where the bodies are, as far as it is prescribed.
   std::vector<Places> places;
};

} // namespace synovia
