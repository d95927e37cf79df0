#pragma once

#include <mpi.h>

#include <memory>
#include <string>

namespace synovia
{

class OutputFile;

/// What a run did and when, a line each with the date and time, in run.log of
/// the output directory. Texts of several lines become one.
class RunLog
{
public:
   /// Starts the file, or goes on with one that is there. Collective; rank 0
   /// writes. Throws Error on all ranks if it can't.
   RunLog(const std::string &directory, MPI_Comm comm, bool append);
   ~RunLog();

   /// Adds a line, which is on disk on return. Collective; the text of rank 0
   /// counts. Throws Error on all ranks if it can't be written.
   void Add(const std::string &text);

   /// The same without a word if it can't be written: for what is said in
   /// passing on an error. Not collective.
   void TryToAdd(const std::string &text) noexcept;

private:
   void Write(const std::string &text);

   MPI_Comm comm;
   std::unique_ptr<OutputFile> file; // rank 0 only
};

} // namespace synovia
