#pragma once

#include "synovia/cases/case_file.hpp"

#include <string>
#include <vector>

namespace synovia
{

/// A step of a case, as a case of its own.
struct CaseOfStep
{
   /// Empty if the case has no steps.
   std::string name;
   mfem::real_t begin = 0.0;
   mfem::real_t end = 0.0;
   /// The case without steps, with the conditions of this one: times count from
   /// the beginning of the run, and it ends when the run does.
   CaseFile setup;
};

/// The steps one after the other; the whole as one, if the case has none. Adds
/// errors for names that stand for nothing.
std::vector<CaseOfStep> CasesOfSteps(const CaseFile &setup,
                                     CaseReading &reading);
/// The same for a case that has been checked.
std::vector<CaseOfStep> CasesOfSteps(const CaseFile &setup);

/// When the last step ends.
mfem::real_t EndOfSteps(const std::vector<StepCase> &steps);

/// What a step changes, in words, for people to read.
std::string ChangesText(const StepCase &step);

} // namespace synovia
