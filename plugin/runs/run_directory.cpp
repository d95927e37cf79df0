#include "synovia/runs/run_directory.hpp"
#include "synovia/general/root_rank.hpp"
#include "synovia/general/version.hpp"
#include "synovia/io/checkpoint_directory.hpp"
#include "synovia/io/output_directory.hpp"
#include "synovia/io/output_file.hpp"
#include "synovia/io/result_files.hpp"

#include <filesystem>
#include <fstream>
#include <sstream>

namespace synovia
{

using mfem::real_t;

namespace
{
// The first line of a case.toml that a run wrote.
constexpr const char *signature = "# As it ran, with all defaults";

const std::string &MadeDirectory(const std::string &path, MPI_Comm comm)
{
   MakeOutputDirectory(path, comm);
   return path;
}

std::string ReadText(const std::string &path)
{
   std::ifstream file(path);
   std::ostringstream text;
   text << file.rdbuf();
   return text.str();
}
} // namespace

RunDirectory::RunDirectory(const std::string &path_, MPI_Comm comm_)
   : path(MadeDirectory(path_, comm_)), comm(comm_), lock(path, comm)
{
   const std::string text = ReadSetup();
   if (!text.empty() && text.rfind(signature, 0) != 0)
   {
      throw Error("'" + SetupPath() +
                  "' is a case that no run wrote, and a run would overwrite "
                  "it; name another directory with --output");
   }
}

bool RunDirectory::IsUsed() const
{
   return OfRoot(IsRoot(comm) && !ListResults(path).empty(), comm);
}

void RunDirectory::VerifyUnused() const
{
   const std::string results = IsRoot(comm) ? ListResults(path) : "";
   ThrowIfAny(comm, results.empty()
                       ? ""
                       : "the output directory '" + path +
                            "' holds results of a run: " + results +
                            "; go on with that run (--resume), replace it "
                            "(--overwrite), or name another directory "
                            "(--output)");
}

void RunDirectory::Clear() const
{
   OnRoot(comm, [&]() { RemoveResults(path); });
}

void RunDirectory::ClearAfter(real_t time, int steps,
                              const std::vector<std::string> &later) const
{
   OnRoot(comm, [&]() { RemoveResultsAfter(path, time, steps); });
   DiscardCheckpointsAfter(Checkpoints(), steps, comm);
   DiscardKeptCheckpoints(Checkpoints(), later, comm);
}

void RunDirectory::WriteSetup(const CaseFile &setup) const
{
   const std::string text = std::string(signature) + ": " + VersionsText() +
                            "\n\n" + SetupText(setup);
   OnRoot(comm, [&]() { ReplaceFile(SetupPath(), text); });
}

std::string RunDirectory::ReadSetup() const
{
   std::string text = IsRoot(comm) ? ReadText(SetupPath()) : "";
   Broadcast(text, comm);
   return text;
}

bool RunDirectory::HasCheckpoint(const std::string &file) const
{
   std::error_code error;
   const bool here =
      IsRoot(comm) &&
      std::filesystem::equivalent(std::filesystem::absolute(file).parent_path(),
                                  Checkpoints(), error) &&
      !error;
   return OfRoot(here, comm);
}

std::string SetupText(const CaseFile &setup)
{
   CaseFile copy(setup);
   copy.output.directory = std::filesystem::absolute(setup.output.directory)
                              .lexically_normal()
                              .string();
   std::ostringstream text;
   WriteCase(copy, text);
   return text.str();
}

} // namespace synovia
