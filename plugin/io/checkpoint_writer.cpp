#include "synovia/io/checkpoint_writer.hpp"
#include "synovia/general/root_rank.hpp"
#include "synovia/io/checkpoint_head.hpp"
#include "synovia/io/checkpoint_layout.hpp"

#include <fcntl.h>
#include <filesystem>
#include <stdexcept>
#include <unistd.h>

namespace synovia
{

namespace
{
namespace head = checkpoint_head;

void SyncAndClose(OutputFile &file)
{
   file.Sync();
   file.Close();
}

/// Waits until the disk has the names of the files in a directory.
void SyncDirectory(const std::filesystem::path &path)
{
   const int descriptor =
      open(path.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
   if (descriptor >= 0)
   {
      fsync(descriptor);
      close(descriptor);
   }
}

CheckpointLayout MakeLayout(const std::string &path,
                            const CheckpointContents &contents)
{
   try
   {
      return CheckpointLayout(contents);
   }
   catch (const std::runtime_error &error)
   {
      throw std::runtime_error("cannot make the checkpoint '" + path +
                               "': " + error.what());
   }
}

/// Gives all ranks what rank 0 has.
void BroadcastSize(std::size_t &size, MPI_Comm comm)
{
   unsigned long long number = size;
   MPI_Bcast(&number, 1, MPI_UNSIGNED_LONG_LONG, 0, comm);
   size = number;
}
} // namespace

CheckpointWriter::Unfinished::~Unfinished()
{
   std::error_code ignored;
   std::filesystem::remove(path, ignored);
}

CheckpointWriter::CheckpointWriter(const std::string &path_,
                                   const CheckpointContents &contents,
                                   MPI_Comm comm_)
   : path(path_), subject("the checkpoint '" + path + "'"), comm(comm_),
     fresh(path + ".new")
{
   if (IsRoot(comm))
   {
      unfinished.emplace(fresh);
   }
   OnRoot(comm,
          [&]()
          {
             const CheckpointLayout layout = MakeLayout(path, contents);
             field_begins = layout.field_begins;
             size = layout.size;
             file = std::make_unique<OutputFile>(
                fresh, OutputFile::Mode::truncate, subject);
             for (const CheckpointLayout::Piece &piece : layout.pieces)
             {
                file->WriteAt(head::size + piece.begin, piece.bytes.data(),
                              piece.bytes.size());
                sum.Add(piece.begin, piece.bytes.data(), piece.bytes.size());
             }
          });
   for (const auto &[name, count] : contents.field_sizes)
   {
      BroadcastSize(field_begins[name], comm);
   }
   OnEachRank(comm,
              [&]()
              {
                 if (!IsRoot(comm))
                 {
                    file = std::make_unique<OutputFile>(
                       fresh, OutputFile::Mode::update, subject);
                 }
              });
}

void CheckpointWriter::Write(const std::string &field, std::size_t begin,
                             const std::vector<double> &values)
{
   if (!failure.empty() || values.empty())
   {
      return;
   }
   const std::size_t place =
      field_begins.at(field) + begin * sizeof(values.front());
   const std::size_t count = values.size() * sizeof(values.front());
   const char *const bytes = reinterpret_cast<const char *>(values.data());
   sum.Add(place, bytes, count);
   try
   {
      file->WriteAt(head::size + place, bytes, count);
   }
   catch (const std::runtime_error &error)
   {
      failure = error.what();
   }
}

void CheckpointWriter::Finish()
{
   ThrowIfAny(comm, failure);
   OnEachRank(comm,
              [&]()
              {
                 if (!IsRoot(comm))
                 {
                    SyncAndClose(*file);
                 }
              });
   std::uint64_t total = sum.Value();
   MPI_Allreduce(MPI_IN_PLACE, &total, 1, MPI_UINT64_T, MPI_SUM, comm);
   OnRoot(comm,
          [&]()
          {
             file->WriteAt(0, head::Text(size, total).data(), head::size);
             SyncAndClose(*file);
             std::error_code error;
             std::filesystem::rename(fresh, path, error);
             if (error)
             {
                throw std::runtime_error("cannot write the checkpoint '" +
                                         path + "': " + error.message());
             }
             // The new name is on the disk only when the directory is.
             SyncDirectory(std::filesystem::absolute(path).parent_path());
          });
}

} // namespace synovia
