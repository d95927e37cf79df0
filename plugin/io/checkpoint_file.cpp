#include "synovia/io/checkpoint_file.hpp"
#include "synovia/general/root_rank.hpp"
#include "synovia/io/checkpoint_groups.hpp"
#include "synovia/io/checkpoint_head.hpp"
#include "synovia/io/hdf5_guard.hpp"
#include "synovia/io/positional_sum.hpp"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <stdexcept>
#include <sys/stat.h>

namespace synovia
{

namespace
{
namespace groups = checkpoint_groups;
namespace head = checkpoint_head;

[[noreturn]] void Fail(const std::string &what, const std::string &path,
                       const std::string &reason)
{
   throw std::runtime_error("cannot " + what + " '" + path + "'" +
                            (reason.empty() ? "" : ": " + reason));
}

/// A file to read bytes from.
class InputFile
{
public:
   explicit InputFile(const std::string &path_) : path(path_)
   {
      errno = 0;
      file.reset(std::fopen(path.c_str(), "rb"));
      if (!file)
      {
         FailToRead();
      }
   }
   std::size_t Size() const
   {
      struct stat status;
      if (fstat(fileno(file.get()), &status) != 0)
      {
         FailToRead();
      }
      return status.st_size;
   }
   void Go(std::size_t begin)
   {
      if (fseeko(file.get(), begin, SEEK_SET) != 0)
      {
         FailToRead();
      }
   }
   /// How many bytes it read, @a count unless the file ends.
   std::size_t Read(char *bytes, std::size_t count)
   {
      const std::size_t n = std::fread(bytes, 1, count, file.get());
      if (n < count && std::ferror(file.get()) != 0)
      {
         FailToRead();
      }
      return n;
   }

private:
   [[noreturn]] void FailToRead() const
   {
      Fail("read the checkpoint", path, std::strerror(errno));
   }

   struct Close
   {
      void operator()(std::FILE *file) const { std::fclose(file); }
   };

   std::string path;
   std::unique_ptr<std::FILE, Close> file;
};

/// The sum of a part of the bytes after the head. @a begin is a multiple of 8.
std::uint64_t SumOf(const std::string &path, std::size_t begin, std::size_t end)
{
   InputFile file(path);
   file.Go(head::size + begin);
   PositionalSum sum;
   std::vector<char> buffer(1 << 16);
   while (begin < end)
   {
      const std::size_t n =
         file.Read(buffer.data(), std::min(buffer.size(), end - begin));
      if (n == 0)
      {
         break;
      }
      sum.Add(begin, buffer.data(), n);
      begin += n;
   }
   return sum.Value();
}

/// Of a file that was not read from yet.
std::string ReadHead(InputFile &file, const std::string &path)
{
   std::string bytes(head::size, '\0');
   bytes.resize(file.Read(bytes.data(), bytes.size()));
   const std::string magic = head::magic;
   const std::string begin = bytes.substr(0, magic.size());
   if (begin.empty() || begin != magic.substr(0, begin.size()))
   {
      throw std::runtime_error("'" + path +
                               "' is no checkpoint of this version");
   }
   return bytes;
}

/// Without locks: some parallel file systems have none.
hid_t OpenFile(const std::string &path)
{
   H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
   const Hdf5Guard access{H5Pcreate(H5P_FILE_ACCESS), H5Pclose};
#if H5_VERSION_GE(1, 10, 7)
   H5Pset_file_locking(access.id, false, true);
#endif
   return Verified(H5Fopen(path.c_str(), H5F_ACC_RDONLY, access.id));
}

hid_t OpenGroup(hid_t file, const char *name)
{
   return Verified(H5Gopen2(file, name, H5P_DEFAULT));
}

hid_t OpenSet(hid_t group, const std::string &name)
{
   return Verified(H5Dopen2(group, name.c_str(), H5P_DEFAULT));
}

std::vector<std::string> Names(hid_t group)
{
   std::vector<std::string> names;
   H5Literate(
      group, H5_INDEX_NAME, H5_ITER_INC, nullptr,
      [](hid_t, const char *name, const H5L_info_t *, void *list) -> herr_t
      {
         static_cast<std::vector<std::string> *>(list)->push_back(name);
         return 0;
      },
      &names);
   return names;
}

std::size_t SizeOf(hid_t set)
{
   const Hdf5Guard space{Verified(H5Dget_space(set)), H5Sclose};
   return Verified(H5Sget_simple_extent_npoints(space.id));
}

template <typename T>
std::vector<T> ReadValues(hid_t group, const std::string &name, hid_t type)
{
   const Hdf5Guard set{OpenSet(group, name), H5Dclose};
   std::vector<T> values(SizeOf(set.id));
   if (!values.empty())
   {
      Verified(
         H5Dread(set.id, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()));
   }
   return values;
}

CheckpointContents ContentsOf(hid_t file)
{
   const Hdf5Guard texts{OpenGroup(file, groups::texts), H5Gclose};
   const Hdf5Guard numbers{OpenGroup(file, groups::numbers), H5Gclose};
   const Hdf5Guard fields{OpenGroup(file, groups::fields), H5Gclose};
   CheckpointContents contents;
   for (const std::string &name : Names(texts.id))
   {
      const auto text = ReadValues<char>(texts.id, name, H5T_NATIVE_CHAR);
      contents.texts[name] = std::string(text.begin(), text.end());
   }
   for (const std::string &name : Names(numbers.id))
   {
      contents.numbers[name] =
         ReadValues<double>(numbers.id, name, H5T_NATIVE_DOUBLE).at(0);
   }
   for (const std::string &name : Names(fields.id))
   {
      const Hdf5Guard set{OpenSet(fields.id, name), H5Dclose};
      contents.field_sizes[name] = SizeOf(set.id);
   }
   return contents;
}
} // namespace

void VerifyCheckpointFile(const std::string &path, MPI_Comm comm)
{
   std::string bytes;
   unsigned long long size = 0;
   OnRoot(comm,
          [&]()
          {
             InputFile file(path);
             bytes = ReadHead(file, path);
             size = file.Size() - bytes.size();
          });
   MPI_Bcast(&size, 1, MPI_UNSIGNED_LONG_LONG, 0, comm);
   int rank = 0;
   int ranks = 1;
   MPI_Comm_rank(comm, &rank);
   MPI_Comm_size(comm, &ranks);
   constexpr std::size_t word = sizeof(std::uint64_t);
   const std::size_t share = (size / word / ranks + 1) * word;
   const std::size_t begin = std::min<std::size_t>(size, rank * share);
   std::uint64_t sum = 0;
   OnEachRank(comm,
              [&]() {
                 sum = SumOf(path, begin,
                             std::min<std::size_t>(size, begin + share));
              });
   MPI_Allreduce(MPI_IN_PLACE, &sum, 1, MPI_UINT64_T, MPI_SUM, comm);
   ThrowIfAny(comm, IsRoot(comm) && bytes != head::Text(size, sum)
                       ? "the checkpoint '" + path +
                            "' is damaged: its contents are not those that "
                            "were written"
                       : "");
}

CheckpointContents ReadCheckpointContents(const std::string &path)
{
   try
   {
      const Hdf5Guard file{OpenFile(path), H5Fclose};
      return ContentsOf(file.id);
   }
   catch (const std::exception &error)
   {
      Fail("take the checkpoint apart", path, error.what());
   }
}

CheckpointFields::CheckpointFields(const std::string &path_) : path(path_)
{
   try
   {
      file = OpenFile(path);
   }
   catch (const std::runtime_error &error)
   {
      Fail("read the checkpoint", path, error.what());
   }
}

CheckpointFields::~CheckpointFields()
{
   H5Fclose(file);
}

std::vector<double> CheckpointFields::Read(const std::string &name,
                                           std::size_t begin,
                                           std::size_t count) const
{
   std::vector<double> values(count);
   if (count == 0)
   {
      return values;
   }
   try
   {
      const Hdf5Guard fields{OpenGroup(file, groups::fields), H5Gclose};
      const Hdf5Guard set{OpenSet(fields.id, name), H5Dclose};
      const Hdf5Guard space{Verified(H5Dget_space(set.id)), H5Sclose};
      const hsize_t first = begin;
      const hsize_t size = count;
      Verified(H5Sselect_hyperslab(space.id, H5S_SELECT_SET, &first, nullptr,
                                   &size, nullptr));
      const Hdf5Guard memory{H5Screate_simple(1, &size, nullptr), H5Sclose};
      Verified(H5Dread(set.id, H5T_NATIVE_DOUBLE, memory.id, space.id,
                       H5P_DEFAULT, values.data()));
   }
   catch (const std::runtime_error &error)
   {
      Fail("read the field '" + name + "' of the checkpoint", path,
           error.what());
   }
   return values;
}

} // namespace synovia
