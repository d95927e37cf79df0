#pragma once

#include <mpi.h>

namespace synovia
{

/// Tells profiling libraries that intercept MPI, by MPI_Pcontrol, that the
/// process is in a phase while this object lives: MPI_Pcontrol(1, name) at its
/// beginning, MPI_Pcontrol(-1) at its end. Phases may be nested. Without such
/// a library it does nothing.
class ProfiledPhase
{
public:
   /// @a name must be a string literal, without commas.
   explicit ProfiledPhase(const char *name) { MPI_Pcontrol(1, name); }
   ~ProfiledPhase() { MPI_Pcontrol(-1); }
   ProfiledPhase(const ProfiledPhase &) = delete;
   ProfiledPhase &operator=(const ProfiledPhase &) = delete;
};

} // namespace synovia
