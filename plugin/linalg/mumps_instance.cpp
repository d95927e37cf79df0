#include "synovia/linalg/mumps_instance.hpp"

#ifdef MFEM_USE_MUMPS

#include "synovia/general/text.hpp"

#include <algorithm>
#include <cmath>

#if MFEM_MUMPS_VERSION < 530
#error "MUMPS >= 5.3 is needed: older ones take right sides on one rank only"
#endif

namespace synovia
{

using namespace mfem;

namespace
{
// Places in ICNTL, CNTL, INFO and INFOG, from 1, and what is put there.
constexpr int error_stream = 1;
constexpr int warning_stream = 2;
constexpr int summary_stream = 3;
constexpr int ordering = 7;
constexpr int workspace_margin = 14;
constexpr int matrix_input = 18;
constexpr int right_side_input = 20;
constexpr int solution_output = 21;
constexpr int memory_per_rank = 23;
constexpr int solution_size = 23;
constexpr int factor_entries = 9;
constexpr int low_rank_blocks = 35;
constexpr int low_rank_accuracy = 7;
constexpr int status = 1;
constexpr int detail = 2;
constexpr int estimated_memory = 16;
constexpr int estimated_operations = 1;

constexpr MUMPS_INT unsymmetric = 0;
constexpr MUMPS_INT spd = 1;
constexpr MUMPS_INT symmetric_indefinite = 2;
constexpr MUMPS_INT distributed_entries = 3;
constexpr MUMPS_INT distributed_right_side = 10;
constexpr MUMPS_INT distributed_solution = 1;
constexpr MUMPS_INT compressed_factors = 2;
constexpr MUMPS_INT given_ordering = 1;
constexpr MUMPS_INT chosen_ordering = 7;

MUMPS_INT Symmetry(MatrixKind kind)
{
   switch (kind)
   {
   case MatrixKind::positive_definite:
      return spd;
   case MatrixKind::symmetric:
      return symmetric_indefinite;
   default:
      return unsymmetric;
   }
}

void Call(DMUMPS_STRUC_C &data)
{
   dmumps_c(&data);
}

#ifdef SYNOVIA_USE_SINGLE_MUMPS
void Call(SMUMPS_STRUC_C &data)
{
   smumps_c(&data);
}
#endif
} // namespace

template <typename Number>
MumpsInstance<Number>::MumpsInstance(MPI_Comm comm, MatrixKind kind,
                                     const DirectOptions &options)
{
   data.sym = Symmetry(kind);
   data.par = 1;
   data.comm_fortran = static_cast<MUMPS_INT>(MPI_Comm_c2f(comm));
   Run(MumpsJob::start);
   const auto set = [&](int place, MUMPS_INT value)
   { data.icntl[place - 1] = value; };
   // Explain() reports failures.
   for (const int stream : {error_stream, warning_stream, summary_stream})
   {
      set(stream, 0);
   }
   set(matrix_input, distributed_entries);
   set(right_side_input, distributed_right_side);
   set(solution_output, distributed_solution);
   set(memory_per_rank, options.memory_limit);
   if (options.compression > 0.0)
   {
      set(low_rank_blocks, compressed_factors);
      data.cntl[low_rank_accuracy - 1] =
         static_cast<Number>(options.compression);
   }
}

template <typename Number>
bool MumpsInstance<Number>::Run(MumpsJob job)
{
   data.job = static_cast<MUMPS_INT>(job);
   Call(data);
   return data.infog[status - 1] >= 0;
}

template <typename Number>
bool MumpsInstance<Number>::Analyze()
{
   data.icntl[ordering - 1] = chosen_ordering;
   return Run(MumpsJob::analyze);
}

template <typename Number>
bool MumpsInstance<Number>::AnalyzeWith(std::vector<MUMPS_INT> &positions)
{
   data.icntl[ordering - 1] = given_ordering;
   data.perm_in = positions.data();
   const bool analyzed = Run(MumpsJob::analyze);
   data.perm_in = nullptr;
   return analyzed;
}

template <typename Number>
std::vector<MUMPS_INT> MumpsInstance<Number>::Positions() const
{
   // Known on the root only.
   return data.sym_perm
             ? std::vector<MUMPS_INT>(data.sym_perm, data.sym_perm + data.n)
             : std::vector<MUMPS_INT>();
}

template <typename Number>
double MumpsInstance<Number>::Operations() const
{
   return data.rinfog[estimated_operations - 1];
}

template <typename Number>
MumpsStatus MumpsInstance<Number>::Status() const
{
   return static_cast<MumpsStatus>(data.infog[status - 1]);
}

template <typename Number>
MUMPS_INT &MumpsInstance<Number>::WorkspaceMargin()
{
   return data.icntl[workspace_margin - 1];
}

template <typename Number>
MUMPS_INT MumpsInstance<Number>::SolutionSize() const
{
   return data.info[solution_size - 1];
}

template <typename Number>
double MumpsInstance<Number>::BytesOfSolve() const
{
   // More than a billion entries are counted in millions, below zero.
   const double number = data.info[factor_entries - 1];
   const double entries = number < 0.0 ? -1e6 * number : number;
   // Symmetric factors are read forward and backward, L and U once each.
   return sizeof(Number) * entries * (data.sym == unsymmetric ? 1.0 : 2.0);
}

template <typename Number>
double MumpsInstance<Number>::MissingMemory() const
{
   const double number = data.infog[detail - 1];
   // Below zero it counts millions of entries, says the users' guide; MUMPS 5.5
   // on several ranks has entries there too. That many millions are none.
   constexpr double most_millions = 1e5;
   const bool millions = number < 0.0 && -number < most_millions;
   return 1e-6 * sizeof(Number) * (millions ? 1e6 : 1.0) * std::abs(number);
}

template <typename Number>
std::string MumpsInstance<Number>::Explain(const std::string &task) const
{
   const std::string who = "MUMPS could not " + task + " (" +
                           std::to_string(data.n) + " unknowns): ";
   const double missing = MissingMemory();
   const double limit = data.icntl[memory_per_rank - 1];
   const double foreseen = data.infog[estimated_memory - 1];
   const double needed = foreseen > limit ? foreseen : limit + missing;
   switch (Status())
   {
   case MumpsStatus::small_index_workspace:
   case MumpsStatus::small_workspace:
   case MumpsStatus::small_memory_limit:
      if (limit > 0.0)
      {
         return who + "it needs about " + Megabytes(needed) + " on a rank, " +
                Megabytes(needed - limit) + " more than direct_memory_limit (" +
                Megabytes(limit) + ") allows";
      }
      return who + "it lacks " + Megabytes(missing) + " on a rank";
   case MumpsStatus::no_memory:
   case MumpsStatus::no_memory_for_numbers:
   case MumpsStatus::no_memory_for_indices:
      return who + "out of memory; it asked for " + Megabytes(missing) +
             " more and needs about " + Megabytes(foreseen) + " on a rank";
   case MumpsStatus::structurally_singular:
   case MumpsStatus::singular:
      return who + "the matrix is singular";
   case MumpsStatus::not_positive_definite:
      return who + "the matrix is not positive definite";
   default:
      return who + "INFOG(1) = " + std::to_string(data.infog[status - 1]) +
             ", INFOG(2) = " + std::to_string(data.infog[detail - 1]);
   }
}

template class MumpsInstance<double>;
#ifdef SYNOVIA_USE_SINGLE_MUMPS
template class MumpsInstance<float>;
#endif

} // namespace synovia

#endif
