// ranks: 1 2 3
//
// Signals that ask a run to stop.

#include "synovia/general/stop_request.hpp"
#include "mfem.hpp"

#include <catch2/catch.hpp>

#include <csignal>
#include <sys/wait.h>
#include <unistd.h>

using namespace synovia;

namespace
{
volatile std::sig_atomic_t outer = 0;

extern "C" void CountOuter(int)
{
   outer = outer + 1;
}
} // namespace

TEST_CASE("A signal on any rank is a request for all of them")
{
   const int signal = GENERATE(SIGINT, SIGTERM, SIGUSR1);
   const StopRequest stop;
   CHECK_FALSE(stop.Pending(MPI_COMM_WORLD));
   CHECK(stop.Signal() == 0);
   const bool last = mfem::Mpi::WorldRank() == mfem::Mpi::WorldSize() - 1;
   if (last)
   {
      std::raise(signal);
   }
   CHECK(stop.Pending(MPI_COMM_WORLD));
   CHECK(stop.Pending(MPI_COMM_WORLD));
   CHECK(stop.Signal() == (last ? signal : 0));
}

TEST_CASE("Afterwards signals do what they did before")
{
   const auto before = std::signal(SIGTERM, CountOuter);
   outer = 0;
   {
      const StopRequest stop;
      std::raise(SIGTERM);
      CHECK(outer == 0);
      CHECK(stop.Signal() == SIGTERM);
   }
   std::raise(SIGTERM);
   CHECK(outer == 1);
   {
      const StopRequest stop;
      // An earlier request is none to this one.
      CHECK_FALSE(stop.Pending(MPI_COMM_WORLD));
   }
   std::signal(SIGTERM, before);
}

TEST_CASE("A second signal ends the process at once")
{
   const int second = GENERATE(SIGINT, SIGTERM);
   const pid_t child = fork();
   REQUIRE(child >= 0);
   if (child == 0)
   {
      // Without MPI from here on.
      const StopRequest stop;
      std::raise(SIGINT);
      if (stop.Signal() == SIGINT)
      {
         std::raise(second);
      }
      _exit(0);
   }
   int status = 0;
   REQUIRE(waitpid(child, &status, 0) == child);
   REQUIRE(WIFSIGNALED(status));
   CHECK(WTERMSIG(status) == second);
}
