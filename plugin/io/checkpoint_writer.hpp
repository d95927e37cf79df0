#pragma once

#include "synovia/io/checkpoint_contents.hpp"
#include "synovia/io/output_file.hpp"
#include "synovia/io/positional_sum.hpp"

#include <mpi.h>

#include <memory>
#include <optional>
#include <vector>

namespace synovia
{

/// Writes a checkpoint to a file that all ranks see, in place of one that is
/// there, such that it is whole or not there after whatever happens, a crash of
/// the machine included. Rank 0 writes all but the values of fields, of which
/// each rank writes its own.
class CheckpointWriter
{
public:
   /// Collective. @a contents are the same on all ranks, but for texts and
   /// numbers, which count on rank 0 only. Throws Error on all ranks, as
   /// Finish() does.
   CheckpointWriter(const std::string &path, const CheckpointContents &contents,
                    MPI_Comm comm);

   /// Not collective. @a begin of the field's values come before; each must be
   /// written by one rank. Finish() says what goes wrong.
   void Write(const std::string &field, std::size_t begin,
              const std::vector<double> &values);
   /// Collective.
   void Finish();

private:
   /// Removes the file at its end, if it is there still.
   struct Unfinished
   {
      std::string path;
      explicit Unfinished(const std::string &path_) : path(path_) {}
      ~Unfinished();
      Unfinished(const Unfinished &) = delete;
      Unfinished &operator=(const Unfinished &) = delete;
   };

   std::string path;
   /// In messages.
   std::string subject;
   MPI_Comm comm;
   /// What is written until it takes its place.
   std::string fresh;
   /// On rank 0.
   std::optional<Unfinished> unfinished;
   std::map<std::string, std::size_t> field_begins;
   std::size_t size = 0;
   PositionalSum sum;
   std::unique_ptr<OutputFile> file;
   /// Why this rank could not write.
   std::string failure;
};

} // namespace synovia
