#include "synovia/runs/resume_command.hpp"
#include "synovia/general/shell_word.hpp"

#include <filesystem>

namespace synovia
{

namespace
{
namespace fs = std::filesystem;

/// The driver: this program, or the one that lies beside it; or else whatever
/// the shell finds.
std::string Driver()
{
   std::error_code error;
   const fs::path program = fs::read_symlink("/proc/self/exe", error);
   const fs::path driver = program.parent_path() / "synovia";
   return !error && fs::exists(driver, error) ? driver.string() : "synovia";
}
} // namespace

std::string ResumeCommand(const std::string &output_directory, MPI_Comm comm)
{
   int ranks = 1;
   MPI_Comm_size(comm, &ranks);
   const fs::path setup = fs::absolute(output_directory) / "case.toml";
   return (ranks > 1 ? "mpirun -n " + std::to_string(ranks) + " " : "") +
          ShellWord(Driver()) + " " +
          ShellWord(setup.lexically_normal().string()) + " --resume";
}

} // namespace synovia
