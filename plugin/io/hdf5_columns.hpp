#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace synovia
{

/// An HDF5 file of columns of doubles, one extendible dataset each.
///
/// For one process. Errors are std::runtime_error with the name of the file and
/// the reason.
class Hdf5Columns
{
public:
   /// Makes the file, replacing one that is there, with columns of no rows.
   Hdf5Columns(const std::string &file, const std::vector<std::string> &names);
   ~Hdf5Columns();
   Hdf5Columns(const Hdf5Columns &) = delete;
   Hdf5Columns &operator=(const Hdf5Columns &) = delete;

   /// Adds rows, a value for each column, and writes what is new, in such an
   /// order that the file is whole at all times, with all rows of before,
   /// whatever happens to the process or the disk.
   void Append(const std::vector<std::vector<double>> &added);

private:
   void Extend(const std::vector<double> &row);
   void Save();
   /// Writes the blocks of @a image that differ from what is in the file.
   void WriteChanges(const char *image);

   std::string path;
   std::int64_t file = -1; // hid_t, kept out of the header
   std::vector<std::int64_t> columns;
   std::uint64_t rows = 0;
   /// What is in the file.
   std::vector<char> saved;
};

/// Reads a column of such a file, closed or still being written.
std::vector<double> ReadHdf5Column(const std::string &file,
                                   const std::string &name);

} // namespace synovia
