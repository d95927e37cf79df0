#pragma once

#include "synovia/cases/case_difference.hpp"
#include "synovia/io/checkpoint.hpp"

#include <string>
#include <vector>

namespace synovia
{

// Permitted differences between a case and the one that it resumes. Errors are
// the same on all ranks.

/// The changes since the checkpoint. Throws Error, which lists them, if there
/// are some that a resumed run must not have, and if the checkpoint does not
/// hold its case.
std::vector<CaseChange> ChangesToResume(const CaseFile &setup,
                                        const Checkpoint &checkpoint);

/// The changes since the checkpoint; none if it does not hold its case.
std::vector<CaseChange> ChangesToRestart(const CaseFile &setup,
                                         const Checkpoint &checkpoint);

/// Throws Error as ChangesToResume() does, for the case.toml in the output
/// directory of a run that left no checkpoint, if there is any text of it.
void VerifySameProblem(const CaseFile &setup, const std::string &text,
                       const std::string &directory);

/// Throws Error if the run would end before the checkpoint.
void VerifyEnd(const CaseFile &setup, const Checkpoint &checkpoint);

} // namespace synovia
