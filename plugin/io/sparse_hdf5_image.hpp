#pragma once

// For sources of the library only, as hdf5_guard.hpp.

#include <hdf5.h>

#include <cstddef>
#include <map>
#include <vector>

namespace synovia
{

/// The bytes of an HDF5 file, of which memory holds only those that HDF5 wrote:
/// space that it merely allocated for data takes none. Bytes that were not
/// written are zero.
class SparseHdf5Image
{
public:
   /// File access properties, to be closed with H5Pclose(), with which HDF5
   /// writes here whatever the name of the file that it creates. The image must
   /// outlive the file.
   hid_t Access();

   /// Until the end of what HDF5 allocated.
   std::size_t Size() const { return size; }
   /// Copies @a count bytes from @a begin on.
   void Read(std::size_t begin, std::size_t count, char *bytes) const;

private:
   struct File;
   friend struct File;
   void Write(std::size_t begin, std::size_t count, const char *bytes);

   std::map<std::size_t, std::vector<char>> pages;
   std::size_t size = 0;
};

} // namespace synovia
