// ranks: 1 2
//
// Files that can't be written, each of which says why, on a disk without space
// above all: that is /dev/full.

#include "synovia/io/output_file.hpp"
#include "support/boxes.hpp"
#include "support/temporary_directory.hpp"
#include "synovia/io/line_sampler.hpp"
#include "synovia/io/run_log.hpp"
#include "synovia/runs/run_directory.hpp"
#include "synovia/synovia.hpp"

#include <catch2/catch.hpp>

#include <filesystem>
#include <fstream>

using namespace mfem;
using namespace synovia;
using Catch::Matchers::Equals;

namespace
{
void MakeFull(const TemporaryDirectory &directory, const std::string &name)
{
   directory.OnRootOnly(
      [&]()
      {
         const std::filesystem::path path = directory / name;
         std::filesystem::create_directories(path.parent_path());
         std::filesystem::create_symlink("/dev/full", path);
      });
}

std::string NoSpace(const std::string &path)
{
   return "cannot write '" + path + "': No space left on device";
}
} // namespace

TEST_CASE("A file is replaced as a whole or not at all")
{
   const TemporaryDirectory directory;
   directory.OnRootOnly(
      [&]()
      {
         const std::string path = directory / "file";
         ReplaceFile(path, "old");
         CHECK(ReadText(path) == "old");
         std::filesystem::create_symlink("/dev/full", path + ".new");
         CHECK_THROWS_WITH(ReplaceFile(path, "new"), Equals(NoSpace(path)));
         CHECK(ReadText(path) == "old");
         CHECK_FALSE(std::filesystem::exists(path + ".new"));
         ReplaceFile(path, "new");
         CHECK(ReadText(path) == "new");
         CHECK_THROWS_WITH(
            OutputFile(path + "/x", OutputFile::Mode::append),
            Equals("cannot write '" + path + "/x': Not a directory"));
         OutputFile(path, OutputFile::Mode::append).Write("er");
         CHECK(ReadText(path) == "newer");
      });
}

TEST_CASE("The log says each time that there is no space")
{
   const TemporaryDirectory directory;
   MakeFull(directory, "run.log");
   RunLog log(directory.Path(), MPI_COMM_WORLD, false);
   for (int i = 0; i < 3; i++)
   {
      CHECK_THROWS_WITH(log.Add("a line"),
                        Equals(NoSpace(directory / "run.log")));
   }
   CHECK_NOTHROW(log.TryToAdd("a line"));
}

TEST_CASE("The log has a line for each text")
{
   const TemporaryDirectory directory;
   {
      RunLog log(directory.Path(), MPI_COMM_WORLD, false);
      log.Add("one");
      log.Add("two:\n  a\n  b");
   }
   RunLog log(directory.Path(), MPI_COMM_WORLD, true);
   log.Add("three");
   MPI_Barrier(MPI_COMM_WORLD);
   std::istringstream text(ReadText(directory / "run.log"));
   std::vector<std::string> lines;
   for (std::string line; std::getline(text, line);)
   {
      REQUIRE(line.size() > 22);
      lines.push_back(line.substr(22));
   }
   CHECK(lines == std::vector<std::string>{"one", "two:; a; b", "three"});
}

TEST_CASE("The case and the lines say it, too")
{
   const TemporaryDirectory directory;
   MakeFull(directory, "case.toml.new");
   MakeFull(directory, "lines/axis_t0.5.csv.new");
   const RunDirectory run(directory.Path(), MPI_COMM_WORLD);
   CaseFile setup;
   setup.mesh.file = "column.msh";
   CHECK_THROWS_WITH(run.WriteSetup(setup),
                     Equals(NoSpace(directory / "case.toml")));
   NamedMesh mesh = MakeBox({});
   LineDefinition line;
   line.name = "axis";
   line.from = {0.5, 0.5, 0.0};
   line.to = {0.5, 0.5, 1.0};
   const LineSampler sampler(mesh, line);
   CHECK_THROWS_WITH(sampler.Write(directory / "lines", 0.5, {}),
                     Equals(NoSpace(directory / "lines/axis_t0.5.csv")));
   CHECK_NOTHROW(sampler.Write(directory / "lines", 0.5, {}));
}
