#pragma once

#include "synovia/io/log_rows.hpp"

#include <optional>

namespace synovia
{

/// The logs of a case, in logs/ of the output directory. Each step adds a block
/// to each of them, as FEBio writes them:
///
///     *Step  = 2
///     *Time  = 0.2
///     *Data  = ux;uy;uz
///     1 0 0 -0.1
///
/// with a row for each node, element or rigid body, its number first. All
/// members are collective.
class LogTables
{
public:
   /// Borrows all arguments. Throws Error where a log names what the mesh does
   /// not have.
   LogTables(const std::vector<LogDefinition> &logs, BiphasicProblem &problem);
   ~LogTables();

   /// Starts the files in @a directory, or goes on with the blocks that are
   /// there up to a time. Throws Error if they can't be written.
   void Open(const std::string &directory, std::optional<mfem::real_t> last);

   /// Adds the blocks of the step that @a stepper has made.
   void Write(TimeStepper &stepper);

private:
   struct Table;

   MPI_Comm comm;
   std::vector<std::unique_ptr<Table>> tables;
};

} // namespace synovia
