#pragma once

#include "synovia/general/error.hpp"

#include "mfem.hpp"

#include <memory>

namespace synovia
{

/// Properties of a matrix that a direct solver may rely on.
enum class MatrixKind
{
   positive_definite,
   symmetric,
   /// With entries at symmetric places, or nearly so.
   general
};

/// The library that factorizes.
enum class DirectLibrary
{
   /// MUMPS where MFEM has it, else UMFPACK.
   automatic,
   /// On any number of ranks.
   mumps,
   /// On one rank.
   umfpack
};

struct DirectOptions
{
   DirectLibrary library = DirectLibrary::automatic;
   /// Most memory that a factorization may take on a rank (MB); 0: no limit.
   int memory_limit = 0;
   /// With MUMPS, blocks of the factors are compressed to low rank with this
   /// relative accuracy (block low-rank factors, Amestoy et al., SIAM J Sci
   /// Comput 37:A1451-A1474, 2015): less time and memory, and factors that are
   /// no more than a preconditioner. 0: exact factors.
   mfem::real_t compression = 0.0;
   /// With MUMPS, if it was built for single precision too, factors have single
   /// precision.
   bool single_precision = false;
};

/// A factorization that failed, or a solve with it, on all ranks alike: the
/// matrix is singular, or memory does not suffice.
class FactorizationError : public Error
{
public:
   using Error::Error;
};

/// Throws Error if MFEM lacks the library, or if it can't serve the ranks of
/// @a comm.
void VerifyDirectLibrary(DirectLibrary library, MPI_Comm comm);

/// A direct factorization of a distributed matrix. A rank may own no rows.
/// SetOperator() of the result, collective, takes another HypreParMatrix of the
/// kind, factorizes it in place of the one before, and keeps the ordering as
/// long as that serves. It throws FactorizationError, as solves do, after which
/// another matrix may be tried. Throws what VerifyDirectLibrary() throws, too.
std::unique_ptr<mfem::Solver>
MakeDirectSolver(const mfem::HypreParMatrix &matrix, MatrixKind kind,
                 const DirectOptions &options = DirectOptions());

} // namespace synovia
