#include "synovia/io/checkpoint_file.hpp"
#include "synovia/io/hdf5_guard.hpp"
#include "synovia/io/output_file.hpp"

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <sstream>
#include <stdexcept>
#include <unistd.h>

namespace synovia
{

namespace
{
// HDF5 leaves the first 512 bytes, the user block, to us: they tell what the
// rest must be.
constexpr std::size_t head_size = 512;
constexpr const char *magic = "synovia checkpoint 1";
constexpr std::size_t memory_increment = 1 << 20;
constexpr const char *groups[3] = {"texts", "numbers", "fields"};

[[noreturn]] void Fail(const std::string &what, const std::string &path,
                       const std::string &reason)
{
   throw std::runtime_error("cannot " + what + " '" + path + "'" +
                            (reason.empty() ? "" : ": " + reason));
}

/// FNV-1a over words of eight bytes.
std::uint64_t Checksum(const std::vector<char> &bytes)
{
   std::uint64_t sum = 14695981039346656037u;
   for (std::size_t i = 0; i < bytes.size(); i += sizeof(sum))
   {
      std::uint64_t word = 0;
      std::memcpy(&word, &bytes[i], std::min(sizeof(word), bytes.size() - i));
      sum = (sum ^ word) * 1099511628211u;
      // Upper bits must reach the lower ones.
      sum ^= sum >> 29;
   }
   return sum;
}

std::string Head(const std::vector<char> &image)
{
   std::ostringstream text;
   text << magic << "\nbytes " << image.size() << "\nsum " << std::hex
        << Checksum(image) << "\n";
   std::string head = text.str();
   head.resize(head_size, '\0');
   return head;
}

/// A slash would be a group of HDF5.
std::string WithoutSlashes(std::string name)
{
   std::replace(name.begin(), name.end(), '/', '|');
   return name;
}

void Check(bool good)
{
   if (!good)
   {
      throw std::runtime_error(Hdf5Reason());
   }
}

void WriteValues(hid_t group, const std::string &name, hid_t file_type,
                 hid_t memory_type, hsize_t count, const void *values)
{
   const Hdf5Guard space{H5Screate_simple(1, &count, nullptr), H5Sclose};
   const Hdf5Guard set{H5Dcreate2(group, WithoutSlashes(name).c_str(),
                                  file_type, space.id, H5P_DEFAULT, H5P_DEFAULT,
                                  H5P_DEFAULT),
                       H5Dclose};
   Check(set.id >= 0);
   Check(count == 0 || H5Dwrite(set.id, memory_type, H5S_ALL, H5S_ALL,
                                H5P_DEFAULT, values) >= 0);
}

/// The HDF5 file in memory: HDF5 1.10 can't close one that it could not write.
std::vector<char> Pack(const CheckpointContents &contents)
{
   H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
   const Hdf5Guard access{H5Pcreate(H5P_FILE_ACCESS), H5Pclose};
   H5Pset_fapl_core(access.id, memory_increment, false);
   const Hdf5Guard file{
      H5Fcreate("checkpoint", H5F_ACC_TRUNC, H5P_DEFAULT, access.id), H5Fclose};
   Check(file.id >= 0);
   hid_t ids[3];
   for (int i = 0; i < 3; i++)
   {
      ids[i] =
         H5Gcreate2(file.id, groups[i], H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
   }
   const Hdf5Guard texts{ids[0], H5Gclose};
   const Hdf5Guard numbers{ids[1], H5Gclose};
   const Hdf5Guard fields{ids[2], H5Gclose};
   for (const auto &[name, text] : contents.texts)
   {
      WriteValues(texts.id, name, H5T_STD_I8LE, H5T_NATIVE_CHAR, text.size(),
                  text.data());
   }
   for (const auto &[name, number] : contents.numbers)
   {
      WriteValues(numbers.id, name, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, 1,
                  &number);
   }
   for (const auto &[name, field] : contents.fields)
   {
      WriteValues(fields.id, name, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE,
                  field.size(), field.data());
   }
   Check(H5Fflush(file.id, H5F_SCOPE_LOCAL) >= 0);
   const ssize_t size = H5Fget_file_image(file.id, nullptr, 0);
   Check(size > 0);
   std::vector<char> image(size);
   Check(H5Fget_file_image(file.id, image.data(), size) == size);
   return image;
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

template <typename T>
std::vector<T> ReadValues(hid_t group, const std::string &name, hid_t type)
{
   const Hdf5Guard set{H5Dopen2(group, name.c_str(), H5P_DEFAULT), H5Dclose};
   Check(set.id >= 0);
   const Hdf5Guard space{H5Dget_space(set.id), H5Sclose};
   std::vector<T> values(H5Sget_simple_extent_npoints(space.id));
   Check(values.empty() || H5Dread(set.id, type, H5S_ALL, H5S_ALL, H5P_DEFAULT,
                                   values.data()) >= 0);
   return values;
}

CheckpointContents Unpack(std::vector<char> &image)
{
   H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
   const Hdf5Guard access{H5Pcreate(H5P_FILE_ACCESS), H5Pclose};
   H5Pset_fapl_core(access.id, memory_increment, false);
   Check(H5Pset_file_image(access.id, image.data(), image.size()) >= 0);
   const Hdf5Guard file{H5Fopen("checkpoint", H5F_ACC_RDONLY, access.id),
                        H5Fclose};
   Check(file.id >= 0);
   const Hdf5Guard texts{H5Gopen2(file.id, groups[0], H5P_DEFAULT), H5Gclose};
   const Hdf5Guard numbers{H5Gopen2(file.id, groups[1], H5P_DEFAULT), H5Gclose};
   const Hdf5Guard fields{H5Gopen2(file.id, groups[2], H5P_DEFAULT), H5Gclose};
   Check(texts.id >= 0 && numbers.id >= 0 && fields.id >= 0);
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
      contents.fields[name] =
         ReadValues<double>(fields.id, name, H5T_NATIVE_DOUBLE);
   }
   return contents;
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

/// The HDF5 file in the file, verified.
std::vector<char> ReadImage(const std::string &path)
{
   const auto reason = [] { return std::string(std::strerror(errno)); };
   errno = 0;
   std::FILE *file = std::fopen(path.c_str(), "rb");
   if (!file)
   {
      Fail("read the checkpoint", path, reason());
   }
   std::vector<char> bytes;
   char buffer[1 << 16];
   for (std::size_t n; (n = std::fread(buffer, 1, sizeof(buffer), file)) > 0;)
   {
      bytes.insert(bytes.end(), buffer, buffer + n);
   }
   const bool failed = std::ferror(file) != 0;
   const std::string why = reason();
   std::fclose(file);
   if (failed)
   {
      Fail("read the checkpoint", path, why);
   }
   const std::size_t length = std::strlen(magic);
   const std::string begin(bytes.begin(),
                           bytes.begin() + std::min(bytes.size(), length));
   if (begin.empty() || begin != std::string(magic).substr(0, begin.size()))
   {
      throw std::runtime_error("'" + path +
                               "' is no checkpoint of this version");
   }
   std::vector<char> image(bytes.begin() + std::min(bytes.size(), head_size),
                           bytes.end());
   const std::string head(bytes.begin(),
                          bytes.begin() + std::min(bytes.size(), head_size));
   if (head != Head(image))
   {
      throw std::runtime_error("the checkpoint '" + path +
                               "' is damaged: its contents are not those that "
                               "were written");
   }
   return image;
}
} // namespace

void WriteCheckpointFile(const std::string &path,
                         const CheckpointContents &contents)
{
   std::vector<char> image;
   try
   {
      image = Pack(contents);
   }
   catch (const std::runtime_error &error)
   {
      Fail("make the checkpoint", path, error.what());
   }
   const std::string head = Head(image);
   const std::string fresh = path + ".new";
   std::error_code error;
   try
   {
      OutputFile file(fresh, OutputFile::Mode::truncate,
                      "the checkpoint '" + path + "'");
      file.Write(head);
      file.Write(image.data(), image.size());
      file.Sync();
      file.Close();
   }
   catch (const std::runtime_error &)
   {
      std::filesystem::remove(fresh, error);
      throw;
   }
   std::filesystem::rename(fresh, path, error);
   if (error)
   {
      const std::string reason = error.message();
      std::filesystem::remove(fresh, error);
      Fail("write the checkpoint", path, reason);
   }
   // The new name is on the disk only when the directory is.
   SyncDirectory(std::filesystem::absolute(path).parent_path());
}

CheckpointContents ReadCheckpointFile(const std::string &path)
{
   std::vector<char> image = ReadImage(path);
   try
   {
      return Unpack(image);
   }
   catch (const std::exception &error)
   {
      Fail("take the checkpoint apart", path, error.what());
   }
}

void VerifyCheckpointFile(const std::string &path)
{
   ReadImage(path);
}

} // namespace synovia
