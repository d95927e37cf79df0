#include "synovia/io/hdf5_columns.hpp"
#include "synovia/io/hdf5_guard.hpp"
#include "synovia/io/output_file.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <stdexcept>

namespace synovia
{

namespace
{
constexpr hsize_t rows_in_a_chunk = 512;
constexpr std::size_t columns_increment = 1 << 16;
// Bytes that are compared, and written, at once.
constexpr std::size_t block = 512;

/// Properties of an open file without locks: a run that is still writing can be
/// looked at, and some parallel file systems have no locks.
hid_t Unlocked()
{
   const hid_t access = H5Pcreate(H5P_FILE_ACCESS);
#if H5_VERSION_GE(1, 10, 7)
   H5Pset_file_locking(access, false, true);
#endif
   return access;
}

[[noreturn]] void Fail(const std::string &what, const std::string &path)
{
   const std::string reason = Hdf5Reason();
   throw std::runtime_error("cannot " + what + " '" + path + "'" +
                            (reason.empty() ? "" : ": " + reason));
}
} // namespace

Hdf5Columns::Hdf5Columns(const std::string &path_,
                         const std::vector<std::string> &names)
   : path(path_)
{
   static_assert(sizeof(hid_t) <= sizeof(std::int64_t), "hid_t is kept here");
   // Errors are reported by exceptions, not on standard error.
   H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
   // In memory: HDF5 1.10 can't close a file that it could not write, on a full
   // disk say, and crashes when the program ends.
   const Hdf5Guard access{H5Pcreate(H5P_FILE_ACCESS), H5Pclose};
   H5Pset_fapl_core(access.id, columns_increment, false);
   file = H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access.id);
   if (file < 0)
   {
      Fail("create", path);
   }
   const hsize_t none = 0;
   const hsize_t unlimited = H5S_UNLIMITED;
   const Hdf5Guard space{H5Screate_simple(1, &none, &unlimited), H5Sclose};
   const Hdf5Guard layout{H5Pcreate(H5P_DATASET_CREATE), H5Pclose};
   H5Pset_chunk(layout.id, 1, &rows_in_a_chunk);
   for (const std::string &name : names)
   {
      columns.push_back(H5Dcreate2(file, name.c_str(), H5T_IEEE_F64LE, space.id,
                                   H5P_DEFAULT, layout.id, H5P_DEFAULT));
      if (columns.back() < 0)
      {
         columns.pop_back();
         Fail("make the column '" + name + "' of", path);
      }
   }
   Save();
}

Hdf5Columns::~Hdf5Columns()
{
   for (const std::int64_t column : columns)
   {
      H5Dclose(column);
   }
   if (file >= 0)
   {
      H5Fclose(file);
   }
}

void Hdf5Columns::Append(const std::vector<std::vector<double>> &added)
{
   for (const std::vector<double> &row : added)
   {
      Extend(row);
   }
   Save();
}

void Hdf5Columns::Extend(const std::vector<double> &row)
{
   if (row.size() != columns.size())
   {
      throw std::logic_error("a row of " + std::to_string(row.size()) +
                             " values for " + std::to_string(columns.size()) +
                             " columns of '" + path + "'");
   }
   const hsize_t one = 1;
   const hsize_t last = rows;
   const hsize_t count = rows + 1;
   const Hdf5Guard memory{H5Screate_simple(1, &one, nullptr), H5Sclose};
   for (std::size_t i = 0; i < columns.size(); i++)
   {
      if (H5Dset_extent(columns[i], &count) < 0)
      {
         Fail("extend", path);
      }
      const Hdf5Guard space{H5Dget_space(columns[i]), H5Sclose};
      if (H5Sselect_hyperslab(space.id, H5S_SELECT_SET, &last, nullptr, &one,
                              nullptr) < 0 ||
          H5Dwrite(columns[i], H5T_NATIVE_DOUBLE, memory.id, space.id,
                   H5P_DEFAULT, &row[i]) < 0)
      {
         Fail("write", path);
      }
   }
   rows = count;
}

void Hdf5Columns::Save()
{
   const bool flushed = H5Fflush(file, H5F_SCOPE_LOCAL) >= 0;
   const ssize_t size = flushed ? H5Fget_file_image(file, nullptr, 0) : -1;
   // For a file in memory: where the pointer to its contents is.
   void *handle = nullptr;
   if (size <= 0 || H5Fget_vfd_handle(file, H5P_DEFAULT, &handle) < 0)
   {
      Fail("make the contents of", path);
   }
   const char *const image = *static_cast<char *const *>(handle);
   // A file that grows has another structure: a chunk more for each column.
   if (static_cast<std::size_t>(size) == saved.size())
   {
      WriteChanges(image);
   }
   else
   {
      ReplaceFile(path, image, size);
      saved.assign(image, image + size);
   }
}

void Hdf5Columns::WriteChanges(const char *image)
{
   errno = 0;
   std::fstream out(path, std::ios::binary | std::ios::in | std::ios::out);
   // Backwards: values, in chunks behind the headers, come before the numbers
   // of rows that make them count.
   const std::size_t blocks = (saved.size() + block - 1) / block;
   for (std::size_t i = blocks; i-- > 0;)
   {
      const std::size_t begin = i * block;
      const std::size_t length = std::min(block, saved.size() - begin);
      if (std::memcmp(image + begin, &saved[begin], length) != 0)
      {
         out.seekp(static_cast<std::streamoff>(begin));
         out.write(image + begin, static_cast<std::streamsize>(length));
         out.flush();
         std::copy_n(image + begin, length, &saved[begin]);
      }
   }
   if (!out)
   {
      throw std::runtime_error("cannot write '" + path +
                               "': " + std::strerror(errno));
   }
}

std::vector<double> ReadHdf5Column(const std::string &file,
                                   const std::string &name)
{
   H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
   const Hdf5Guard access{Unlocked(), H5Pclose};
   const Hdf5Guard opened{H5Fopen(file.c_str(), H5F_ACC_RDONLY, access.id),
                          H5Fclose};
   if (opened.id < 0)
   {
      Fail("open", file);
   }
   const Hdf5Guard column{H5Dopen2(opened.id, name.c_str(), H5P_DEFAULT),
                          H5Dclose};
   if (column.id < 0)
   {
      Fail("find the column '" + name + "' of", file);
   }
   const Hdf5Guard space{H5Dget_space(column.id), H5Sclose};
   std::vector<double> values(H5Sget_simple_extent_npoints(space.id));
   if (H5Dread(column.id, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT,
               values.data()) < 0)
   {
      Fail("read", file);
   }
   return values;
}

} // namespace synovia
