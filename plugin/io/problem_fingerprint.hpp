#pragma once

#include "synovia/io/checkpoint_contents.hpp"
#include "synovia/physics/biphasic_problem.hpp"

#include <string>

namespace synovia
{

// What of a problem must be the same in the run that wrote a checkpoint and in
// the one that reads it: the mesh with its regions and surfaces, the unknowns,
// whether deformation is finite, and the contact pairs.

/// Adds it to what a checkpoint holds. Collective.
void AddFingerprint(BiphasicProblem &problem, CheckpointContents &contents);

/// How the problem of a checkpoint, @a theirs, differs from this one, @a ours,
/// in words; empty if it doesn't.
std::string CompareFingerprints(const CheckpointContents &theirs,
                                const CheckpointContents &ours);

} // namespace synovia
