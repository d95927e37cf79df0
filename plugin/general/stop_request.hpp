#pragma once

#include <csignal>
#include <mpi.h>

namespace synovia
{

/// While it lives, SIGINT (Ctrl-C), SIGTERM and SIGUSR1 only ask the run to
/// stop, and a second one ends the process as it would have without. Afterwards
/// they do what they did before. One object at a time.
///
/// Ctrl-C at Open MPI's mpirun leaves the ranks a second, or what its parameter
/// odls_base_sigkill_timeout says, before it kills them. It hands SIGUSR1 on
/// and waits: `kill -USR1 <mpirun>` is the way to stop a run of long steps.
class StopRequest
{
public:
   StopRequest();
   ~StopRequest();
   StopRequest(const StopRequest &) = delete;
   StopRequest &operator=(const StopRequest &) = delete;

   /// Whether any rank was asked to stop: the signal does not come to all of
   /// them at the same time. Collective; all ranks get the same.
   bool Pending(MPI_Comm comm) const;

   /// The signal that this rank got, or 0.
   int Signal() const;

private:
   static constexpr int signals[3] = {SIGINT, SIGTERM, SIGUSR1};
   struct sigaction before[3];
};

} // namespace synovia
