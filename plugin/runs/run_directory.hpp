#pragma once

#include "synovia/cases/case_file.hpp"
#include "synovia/io/directory_lock.hpp"

#include <string>
#include <vector>

namespace synovia
{

/// The output directory of a run, which has it for itself as long as this
/// lives. All members are collective, and errors are the same on all ranks.
class RunDirectory
{
public:
   /// Makes the directory where needed and locks it. Throws Error if it can't
   /// be written into, if another run is in progress there, or if it has a
   /// case.toml that no run wrote, which this one would overwrite.
   RunDirectory(const std::string &path, MPI_Comm comm);

   /// Whether there are results of a run.
   bool IsUsed() const;
   /// Throws Error if there are; it lists them and says what
   /// can be done.
   void VerifyUnused() const;
   /// Removes what runs have written. All else stays.
   void Clear() const;
   /// Removes what runs have written of later times and time steps, and what
   /// is kept of the ends of the @a later steps.
   void ClearAfter(mfem::real_t time, int steps,
                   const std::vector<std::string> &later) const;

   /// Writes the case, with all defaults, to case.toml.
   void WriteSetup(const CaseFile &setup) const;
   /// Its text, perhaps from an earlier run; empty if there is no such file.
   std::string ReadSetup() const;

   std::string Checkpoints() const { return path + "/checkpoint"; }
   /// Whether the file is one of this directory's checkpoints.
   bool HasCheckpoint(const std::string &file) const;

   /// Why another run could get in after all, or nothing.
   const std::string &Doubt() const { return lock.Doubt(); }

private:
   std::string SetupPath() const { return path + "/case.toml"; }

   std::string path;
   MPI_Comm comm;
   DirectoryLock lock;
};

/// The case as TOML that reads back the same from anywhere: paths are absolute.
std::string SetupText(const CaseFile &setup);

} // namespace synovia
