#include "synovia/linalg/direct_solver.hpp"

// The tests leave out one library or the other.
#if defined(MFEM_USE_MUMPS) && !defined(SYNOVIA_WITHOUT_MUMPS)
#define SYNOVIA_HAS_MUMPS
#include "synovia/linalg/mumps_solver.hpp"
#endif
#if defined(MFEM_USE_SUITESPARSE) && !defined(SYNOVIA_WITHOUT_UMFPACK)
#define SYNOVIA_HAS_UMFPACK
#include "synovia/linalg/umfpack_solver.hpp"
#endif

namespace synovia
{

using namespace mfem;

namespace
{
#ifdef SYNOVIA_HAS_MUMPS
constexpr bool has_mumps = true;
#else
constexpr bool has_mumps = false;
#endif
#ifdef SYNOVIA_HAS_UMFPACK
constexpr bool has_umfpack = true;
#else
constexpr bool has_umfpack = false;
#endif

DirectLibrary Choose(DirectLibrary library)
{
   if (library != DirectLibrary::automatic)
   {
      return library;
   }
   return has_mumps ? DirectLibrary::mumps : DirectLibrary::umfpack;
}

#ifdef SYNOVIA_HAS_MUMPS
std::unique_ptr<Solver> MakeMumpsSolver(MPI_Comm comm, MatrixKind kind,
                                        const DirectOptions &options)
{
#ifdef SYNOVIA_USE_SINGLE_MUMPS
   if (options.single_precision)
   {
      return std::make_unique<MumpsSolver<float>>(comm, kind, options);
   }
#endif
   return std::make_unique<MumpsSolver<double>>(comm, kind, options);
}
#endif
} // namespace

void VerifyDirectLibrary(DirectLibrary library, MPI_Comm comm)
{
   const bool mumps = Choose(library) == DirectLibrary::mumps;
   if (mumps ? !has_mumps : !has_umfpack)
   {
      const std::string missing = mumps ? "MUMPS" : "UMFPACK (SuiteSparse)";
      throw Error("this MFEM was built without " + missing);
   }
   int ranks = 1;
   MPI_Comm_size(comm, &ranks);
   if (!mumps && ranks > 1)
   {
      const std::string others =
         has_mumps ? "use MUMPS" : "use an MFEM that has MUMPS";
      throw Error("UMFPACK works on one rank, and there are " +
                  std::to_string(ranks) + ": run on one, or " + others);
   }
}

std::unique_ptr<Solver> MakeDirectSolver(const HypreParMatrix &matrix,
                                         [[maybe_unused]] MatrixKind kind,
                                         const DirectOptions &options)
{
   VerifyDirectLibrary(options.library, matrix.GetComm());
   std::unique_ptr<Solver> solver;
#ifdef SYNOVIA_HAS_MUMPS
   if (Choose(options.library) == DirectLibrary::mumps)
   {
      solver = MakeMumpsSolver(matrix.GetComm(), kind, options);
   }
#endif
#ifdef SYNOVIA_HAS_UMFPACK
   if (Choose(options.library) == DirectLibrary::umfpack)
   {
      solver = std::make_unique<UmfpackSolver>(options.memory_limit);
   }
#endif
   solver->SetOperator(matrix);
   return solver;
}

} // namespace synovia
