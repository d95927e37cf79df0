#pragma once

#include "synovia/linalg/direct_solver.hpp"

#ifdef MFEM_USE_MUMPS

#include <dmumps_c.h>
#ifdef SYNOVIA_USE_SINGLE_MUMPS
#include <smumps_c.h>
#endif

#include <string>
#include <vector>

namespace synovia
{

/// Jobs of MUMPS; numbers of its users' guide, as below.
enum class MumpsJob
{
   start = -1,
   finish = -2,
   analyze = 1,
   factorize = 2,
   solve = 3
};

/// INFOG(1) of failures that can be mended, or explained in other words.
enum class MumpsStatus
{
   no_memory_for_numbers = -5,
   structurally_singular = -6,
   no_memory_for_indices = -7,
   small_index_workspace = -8,
   small_workspace = -9,
   singular = -10,
   no_memory = -13,
   small_send_buffer = -17,
   small_memory_limit = -19,
   small_receive_buffer = -20,
   not_positive_definite = -40
};

/// MUMPS' structure for a type of numbers.
template <typename Number>
struct MumpsData;
template <>
struct MumpsData<double>
{
   using Type = DMUMPS_STRUC_C;
};
#ifdef SYNOVIA_USE_SINGLE_MUMPS
template <>
struct MumpsData<float>
{
   using Type = SMUMPS_STRUC_C;
};
#endif

/// MUMPS' data of one matrix of such numbers. Collective to make, to run and to
/// end.
template <typename Number>
class MumpsInstance
{
public:
   MumpsInstance(MPI_Comm comm, MatrixKind kind, const DirectOptions &options);
   ~MumpsInstance() { Run(MumpsJob::finish); }
   MumpsInstance(const MumpsInstance &) = delete;
   MumpsInstance &operator=(const MumpsInstance &) = delete;

   /// Whether the job succeeded, on all ranks alike.
   bool Run(MumpsJob job);
   /// Analyzes the matrix with an ordering of MUMPS' choice, or with
   /// @a positions, which are read on the root, of an ordering of a like
   /// matrix; says what Run() says.
   bool Analyze();
   bool AnalyzeWith(std::vector<MUMPS_INT> &positions);
   /// Of an analyzed matrix: positions of its unknowns in the order of
   /// elimination, on the root, and how many operations that takes.
   std::vector<MUMPS_INT> Positions() const;
   double Operations() const;
   /// Of the last job, if it failed.
   MumpsStatus Status() const;
   /// Says why the last job failed: @a task is what could not be done.
   std::string Explain(const std::string &task) const;
   /// How much more workspace than foreseen is set aside, in percent.
   MUMPS_INT &WorkspaceMargin();
   /// Entries of a solution on this rank, once there are factors.
   MUMPS_INT SolutionSize() const;
   /// Bytes of this rank's factors that a solve reads, once there are any.
   double BytesOfSolve() const;

   typename MumpsData<Number>::Type data{};

private:
   /// Megabytes that MUMPS lacked, or could not allocate.
   double MissingMemory() const;
};

} // namespace synovia

#endif
