// ranks: 1 2 3
//
// What a run leaves in its output directory: who may write there, what counts
// as a result, and what is removed before another run.

#include "synovia/io/result_files.hpp"
#include "support/temporary_directory.hpp"
#include "synovia/general/error.hpp"
#include "synovia/runs/run_directory.hpp"

#include <catch2/catch.hpp>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <set>
#include <sys/wait.h>
#include <unistd.h>

using namespace synovia;
using Catch::Matchers::Contains;

namespace
{
const std::set<std::string> results{"checkpoint/checkpoint_00000010.h5",
                                    "checkpoint/checkpoint_00000020.h5",
                                    "checkpoint/checkpoint_00000030.h5.new",
                                    "checkpoint/step_press.h5",
                                    "checkpoint/step_slide.h5",
                                    "fields/bodies/Cycle000010/data.pvtu",
                                    "fields/bodies/Cycle000010/proc000000.vtu",
                                    "fields/bodies/Cycle000020/data.pvtu",
                                    "fields/bodies/bodies.pvd",
                                    "history.csv",
                                    "history.h5",
                                    "lines/axis_t1e+02.csv",
                                    "lines/top_t0_t250.csv",
                                    "logs/nodes.txt"};
const std::set<std::string> about{"case.toml", "report.html", "run.log"};
const std::set<std::string> foreign{"fields/bodies/Cycle000020/notes.txt",
                                    "fields/view.pvsm",
                                    "history.csv.bak",
                                    "lines/measured.csv",
                                    "mesh.msh",
                                    "checkpoint/mine.h5",
                                    "pictures/axis.png"};

constexpr const char *our_case = "# As it ran, with all defaults: x\n";

void Fill(const TemporaryDirectory &directory,
          const std::set<std::string> &names)
{
   directory.OnRootOnly(
      [&]()
      {
         for (const std::string &name : names)
         {
            const std::filesystem::path path = directory / name;
            std::filesystem::create_directories(path.parent_path());
            std::ofstream(path) << (name == "case.toml" ? our_case : "text\n");
         }
      });
}

std::set<std::string> Files(const TemporaryDirectory &directory)
{
   MPI_Barrier(directory.GetComm());
   std::set<std::string> names;
   for (const auto &entry :
        std::filesystem::recursive_directory_iterator(directory.Path()))
   {
      if (entry.is_regular_file())
      {
         names.insert(
            entry.path().lexically_relative(directory.Path()).string());
      }
   }
   names.erase(".synovia-lock");
   MPI_Barrier(directory.GetComm());
   return names;
}

std::set<std::string> Union(const std::set<std::string> &a,
                            const std::set<std::string> &b)
{
   std::set<std::string> both(a);
   both.insert(b.begin(), b.end());
   return both;
}

std::string MessageOf(const TemporaryDirectory &directory)
{
   try
   {
      RunDirectory(directory.Path(), MPI_COMM_WORLD).VerifyUnused();
   }
   catch (const Error &error)
   {
      return error.what();
   }
   return "";
}
} // namespace

TEST_CASE("A directory with results of a run is refused, and they are listed")
{
   const TemporaryDirectory directory;
   Fill(directory, Union(results, foreign));
   CHECK(
      MessageOf(directory) ==
      "the output directory '" + directory.Path() +
         "' holds results of a run: history.csv, history.h5, checkpoint/ "
         "(5 files), fields/ (4 files), lines/ (2 files), logs/ (1 file); go "
         "on "
         "with that run (--resume), replace it (--overwrite), or name another "
         "directory (--output)");
   CHECK(Files(directory) == Union(results, foreign));
}

TEST_CASE("What a run leaves that failed at once is no result")
{
   const TemporaryDirectory directory;
   Fill(directory, Union(about, foreign));
   directory.OnRootOnly(
      [&]()
      { std::filesystem::create_directories(directory / "fields/bodies/x"); });
   CHECK(MessageOf(directory).empty());
}

TEST_CASE("Exactly what runs write is removed before another one")
{
   const TemporaryDirectory directory;
   Fill(directory, Union(Union(results, about), foreign));
   const RunDirectory run(directory.Path(), MPI_COMM_WORLD);
   CHECK(run.IsUsed());
   run.Clear();
   CHECK(Files(directory) == foreign);
   CHECK_FALSE(run.IsUsed());
   MPI_Barrier(MPI_COMM_WORLD);
   CHECK_FALSE(
      std::filesystem::exists(directory / "fields/bodies/Cycle000010"));
   CHECK(std::filesystem::exists(directory / "fields/bodies/Cycle000020"));
}

TEST_CASE("What comes after a checkpoint goes, and the rest stays")
{
   const TemporaryDirectory directory;
   Fill(directory, Union(results, about));
   const std::string begin = "<VTKFile>\n<Collection>\n";
   const auto entry = [](const std::string &cycle)
   {
      return "<DataSet timestep=\"1\" group=\"\" part=\"0\" file=\"Cycle" +
             cycle + "/data.pvtu\" name=\"mesh\"/>\n";
   };
   const std::string end = "</Collection>\n</VTKFile>\n";
   directory.Write("fields/bodies/bodies.pvd",
                   begin + entry("000010") + entry("000020") + end);
   const RunDirectory run(directory.Path(), MPI_COMM_WORLD);
   run.ClearAfter(100.0, 10, {"slide"});
   CHECK(Files(directory) ==
         std::set<std::string>{
            "case.toml", "checkpoint/checkpoint_00000010.h5",
            "checkpoint/step_press.h5", "fields/bodies/Cycle000010/data.pvtu",
            "fields/bodies/Cycle000010/proc000000.vtu",
            "fields/bodies/bodies.pvd", "history.csv", "history.h5",
            "lines/axis_t1e+02.csv", "logs/nodes.txt", "run.log"});
   CHECK(ReadText(directory / "fields/bodies/bodies.pvd") ==
         begin + entry("000010") + end);
   CHECK(run.HasCheckpoint(directory / "checkpoint/checkpoint_00000010.h5"));
   CHECK_FALSE(run.HasCheckpoint(directory / "checkpoint_00000010.h5"));
}

TEST_CASE("A case that no run wrote is not overwritten")
{
   const TemporaryDirectory directory;
   directory.Write("case.toml", "title = \"mine\"\n");
   CHECK_THAT(MessageOf(directory),
              Contains("case.toml' is a case that no run wrote") &&
                 Contains("--output"));
   CHECK(ReadText(directory / "case.toml") == "title = \"mine\"\n");
}

TEST_CASE("A directory is one run's while that lives")
{
   const TemporaryDirectory directory;
   {
      const RunDirectory first(directory.Path(), MPI_COMM_WORLD);
      CHECK(first.Doubt().empty());
      char host[256] = "";
      gethostname(host, sizeof(host) - 1);
      CHECK_THAT(MessageOf(directory),
                 Contains("the output directory '" + directory.Path() +
                          "' is that of a run in progress (process ") &&
                    Contains(std::string(" on ") + host + ", since 2") &&
                    Contains("wait for its end, or name another directory "
                             "with --output"));
   }
   CHECK(MessageOf(directory).empty());
   CHECK(Files(directory).empty());
   MPI_Barrier(MPI_COMM_WORLD);
   CHECK_FALSE(std::filesystem::exists(directory / ".synovia-lock"));
}

TEST_CASE("A note that a killed run left locks nothing")
{
   const TemporaryDirectory directory;
   directory.Write(".synovia-lock", "process 1 on nowhere, since long");
   CHECK(MessageOf(directory).empty());
}
