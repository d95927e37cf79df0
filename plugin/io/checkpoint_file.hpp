#pragma once

#include "synovia/io/checkpoint_contents.hpp"

#include <mpi.h>

#include <cstdint>
#include <string>
#include <vector>

namespace synovia
{

/// Collective: throws Error on all ranks if the file is not a whole checkpoint.
/// Every rank reads a part of it; the sum covers every byte.
void VerifyCheckpointFile(const std::string &path, MPI_Comm comm);

/// What the file holds. For one process; errors are std::runtime_error with the
/// name of the file and the reason.
CheckpointContents ReadCheckpointContents(const std::string &path);

/// Reads values of the fields of a checkpoint. For one process; errors as
/// above.
class CheckpointFields
{
public:
   explicit CheckpointFields(const std::string &path);
   ~CheckpointFields();
   CheckpointFields(const CheckpointFields &) = delete;
   CheckpointFields &operator=(const CheckpointFields &) = delete;

   /// @a count values, of which @a begin come before.
   std::vector<double> Read(const std::string &name, std::size_t begin,
                            std::size_t count) const;

private:
   std::string path;
   /// Identifier of HDF5.
   std::int64_t file;
};

} // namespace synovia
