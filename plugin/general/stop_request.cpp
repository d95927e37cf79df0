#include "synovia/general/stop_request.hpp"

namespace synovia
{

namespace
{
// A signal handler has nothing but this to write to.
volatile std::sig_atomic_t received = 0;

extern "C" void Note(int signal)
{
   if (received == 0)
   {
      received = signal;
      return;
   }
   // Who asks twice does not want to wait for the step. The signal is blocked
   // until the handler is left.
   struct sigaction usual = {};
   usual.sa_handler = SIG_DFL;
   sigaction(signal, &usual, nullptr);
   raise(signal);
}
} // namespace

StopRequest::StopRequest()
{
   received = 0;
   struct sigaction note = {};
   note.sa_handler = Note;
   // Reading and writing go on after a signal.
   note.sa_flags = SA_RESTART;
   for (int i = 0; i < 3; i++)
   {
      sigaction(signals[i], &note, &before[i]);
   }
}

StopRequest::~StopRequest()
{
   for (int i = 0; i < 3; i++)
   {
      sigaction(signals[i], &before[i], nullptr);
   }
   received = 0;
}

bool StopRequest::Pending(MPI_Comm comm) const
{
   int pending = received != 0;
   MPI_Allreduce(MPI_IN_PLACE, &pending, 1, MPI_INT, MPI_MAX, comm);
   return pending != 0;
}

int StopRequest::Signal() const
{
   return received;
}

} // namespace synovia
