#pragma once

#include <mpi.h>

namespace synovia
{

/// Tells profiling libraries, by MPI_Pcontrol(2, name, bytes) and
/// MPI_Pcontrol(-2), that this rank does a piece of work while this object
/// lives, for which so many bytes of matrices and factors are read. Pieces may
/// be nested: what is inside has its own bytes. Without such a library it does
/// nothing.
class ProfiledWork
{
public:
   /// @a name must be a string literal, without commas; @a bytes is a number
   /// of this rank's.
   ProfiledWork(const char *name, double bytes)
   {
      MPI_Pcontrol(2, name, bytes);
   }
   ~ProfiledWork() { MPI_Pcontrol(-2); }
   ProfiledWork(const ProfiledWork &) = delete;
   ProfiledWork &operator=(const ProfiledWork &) = delete;
};

} // namespace synovia
