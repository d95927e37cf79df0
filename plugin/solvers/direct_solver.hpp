#pragma once

#include "mfem.hpp"

#include <memory>

namespace synovia
{

/// What a direct solver may rely on.
enum class MatrixKind
{
   positive_definite,
   symmetric
};

/// A direct factorisation of a distributed matrix: MUMPS where MFEM has it, on
/// any number of ranks; else UMFPACK on one rank. Throws Error if MFEM has
/// neither. A rank may own no rows. SetOperator() of the result, collective,
/// takes another HypreParMatrix of the kind, factorises it in place of the one
/// before, and keeps the ordering if its entries are at the same places.
std::unique_ptr<mfem::Solver>
MakeDirectSolver(const mfem::HypreParMatrix &matrix, MatrixKind kind);

} // namespace synovia
