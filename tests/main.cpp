// The main program of all tests: Catch2 on every rank of MPI_COMM_WORLD.
//
// Rank 0 reports; the others keep their reports back and give them only with a
// test case that failed on them. A test program succeeds if it does so on all
// ranks and each of them has checked something: a parallel test that skips its
// assertions on some rank would otherwise pass there.

#define CATCH_CONFIG_RUNNER
#include <catch2/catch.hpp>

#include "mfem.hpp"

#include <execinfo.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <iostream>
#include <sstream>
#include <thread>

#ifdef SYNOVIA_SANITIZE
#include <sanitizer/lsan_interface.h>

// At exit, what OpenMPI has allocated looks lost, since MPI_Finalize unloads
// the parts of it that knew. So leaks are looked for before that, below; those
// that it and gmsh have while they run are not ours.
extern "C" const char *__lsan_default_options()
{
   return "leak_check_at_exit=0:print_suppressions=0";
}
// gmsh deletes arrays as if they were single objects.
extern "C" const char *__asan_default_options()
{
   return "alloc_dealloc_mismatch=0";
}
extern "C" const char *__lsan_default_suppressions()
{
   return "leak:libmpi\nleak:libopen-rte\nleak:libopen-pal\nleak:libpmix\n"
          "leak:libgmsh\n";
}
#endif

namespace
{

// How long a rank on which a test case failed waits for the others. They may
// be waiting for it, in a collective that it did not get to.
constexpr std::chrono::seconds patience(20);

// Before a run is ended for taking too long, each rank says where it is. Only
// the handler of a signal can, in a rank that hangs.
void TellWhere(int)
{
   constexpr char message[] = "A rank of this test is still busy, here:\n";
   const ssize_t written = write(STDERR_FILENO, message, sizeof(message) - 1);
   void *frames[64];
   if (written > 0)
   {
      backtrace_symbols_fd(frames, backtrace(frames, 64), STDERR_FILENO);
   }
}

void WatchTime()
{
   // The first call loads a library, which a handler must not do.
   void *frame = nullptr;
   backtrace(&frame, 1);
   std::signal(SIGALRM, TellWhere);
   const char *const limit = std::getenv("SYNOVIA_TEST_SECONDS");
   constexpr int spare = 5;
   const int seconds = limit ? std::atoi(limit) : 0;
   if (seconds > spare)
   {
      alarm(seconds - spare);
   }
}

std::ostringstream held_back;
MPI_Comm test_comm = MPI_COMM_NULL;
std::size_t assertions = 0;

class RankListener : public Catch::TestEventListenerBase
{
public:
   using TestEventListenerBase::TestEventListenerBase;

   /// Keeps the ranks in step, so that a failure on one of them does not
   /// disturb the next test case, and ends the run where they can't be.
   void testCaseEnded(const Catch::TestCaseStats &stats) override
   {
      const bool failed = stats.totals.testCases.failed > 0;
      if (failed && !mfem::Mpi::Root())
      {
         std::cerr << "On rank " << mfem::Mpi::WorldRank() << ":\n"
                   << held_back.str() << std::endl;
      }
      held_back.str("");

      MPI_Request request;
      MPI_Ibarrier(test_comm, &request);
      const auto start = std::chrono::steady_clock::now();
      int done = 0;
      MPI_Test(&request, &done, MPI_STATUS_IGNORE);
      while (!done)
      {
         if (failed && std::chrono::steady_clock::now() - start > patience)
         {
            std::cerr << "Rank " << mfem::Mpi::WorldRank() << ": \""
                      << stats.testInfo.name
                      << "\" failed here, and other ranks hang in it"
                      << std::endl;
            MPI_Abort(MPI_COMM_WORLD, 1);
         }
         std::this_thread::sleep_for(std::chrono::milliseconds(1));
         MPI_Test(&request, &done, MPI_STATUS_IGNORE);
      }
   }

   void testRunEnded(const Catch::TestRunStats &stats) override
   {
      assertions = stats.totals.assertions.total();
   }
};

CATCH_REGISTER_LISTENER(RankListener)

void InitializeMpi(int argc, char *argv[])
{
#ifdef SYNOVIA_SANITIZE
   const __lsan::ScopedDisabler openmpi_loses_a_few_strings;
#endif
   mfem::Mpi::Init(argc, argv);
   mfem::Hypre::Init();
   // Tests must not get each other's messages, or those of this program.
   MPI_Comm_dup(MPI_COMM_WORLD, &test_comm);
}

/// Has this rank lost memory so far? It says where.
bool HasLeaks()
{
#ifdef SYNOVIA_SANITIZE
   return __lsan_do_recoverable_leak_check() != 0;
#else
   return false;
#endif
}

/// The status of this rank alone.
int RunSession(int argc, char *argv[])
{
   Catch::Session session;
   int status = session.applyCommandLine(argc, argv);
   const Catch::ConfigData &config = session.configData();
   if (status != 0 || config.showHelp || config.libIdentify)
   {
      return status;
   }
   if (config.listTests || config.listTags || config.listReporters ||
       config.listTestNamesOnly)
   {
      session.run(); // gives the number of what it lists
      return 0;
   }
   status = session.run();
   if (status == 0 && assertions == 0)
   {
      std::cerr << "Rank " << mfem::Mpi::WorldRank() << " has checked nothing"
                << std::endl;
      return 1;
   }
   return status;
}

} // namespace

int main(int argc, char *argv[])
{
   WatchTime();
   InitializeMpi(argc, argv);

   std::streambuf *const console = std::cout.rdbuf();
   if (!mfem::Mpi::Root())
   {
      std::cout.rdbuf(held_back.rdbuf());
   }
   int status = RunSession(argc, argv);
   std::cout.rdbuf(console);
   if (HasLeaks())
   {
      status = 1;
   }

   MPI_Allreduce(MPI_IN_PLACE, &status, 1, MPI_INT, MPI_MAX, test_comm);
   MPI_Comm_free(&test_comm);
   // The number of failures does not fit into an exit status.
   return status == 0 ? 0 : 1;
}
