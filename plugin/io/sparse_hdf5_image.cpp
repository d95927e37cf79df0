#include "synovia/io/sparse_hdf5_image.hpp"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <memory>

#if H5_VERSION_GE(1, 13, 0)
#include <H5FDdevelop.h>
#endif

namespace synovia
{

namespace
{
constexpr std::size_t page_size = 4096;

/// Calls @a work with a page's number, the place in the page, and the place in
/// the range and the number of its bytes that are there.
template <typename Work>
void ForEachPage(std::size_t begin, std::size_t count, Work work)
{
   for (std::size_t done = 0; done < count;)
   {
      const std::size_t at = (begin + done) % page_size;
      const std::size_t here = std::min(page_size - at, count - done);
      work((begin + done) / page_size, at, done, here);
      done += here;
   }
}
} // namespace

/// What HDF5 asks of a file, for H5FDregister(); it wants H5FD_t first.
struct SparseHdf5Image::File
{
   H5FD_t base;
   SparseHdf5Image *image;

   static File &Of(H5FD_t *file) { return *reinterpret_cast<File *>(file); }
   static const File &Of(const H5FD_t *file)
   {
      return *reinterpret_cast<const File *>(file);
   }

   static H5FD_t *Open(const char *, unsigned, hid_t access, haddr_t)
   {
      const void *info = H5Pget_driver_info(access);
      if (!info)
      {
         return nullptr;
      }
      auto file = std::make_unique<File>();
      file->image = *static_cast<SparseHdf5Image *const *>(info);
      return &file.release()->base;
   }
   static herr_t Close(H5FD_t *file)
   {
      const std::unique_ptr<File> closed(&Of(file));
      return 0;
   }
   static haddr_t GetSize(const H5FD_t *file, H5FD_mem_t)
   {
      return Of(file).image->size;
   }
   static herr_t SetSize(H5FD_t *file, H5FD_mem_t, haddr_t size)
   {
      Of(file).image->size = size;
      return 0;
   }
   static herr_t Read(H5FD_t *file, H5FD_mem_t, hid_t, haddr_t begin,
                      std::size_t count, void *bytes)
   {
      Of(file).image->Read(begin, count, static_cast<char *>(bytes));
      return 0;
   }
   static herr_t Write(H5FD_t *file, H5FD_mem_t, hid_t, haddr_t begin,
                       std::size_t count, const void *bytes)
   {
      Of(file).image->Write(begin, count, static_cast<const char *>(bytes));
      return 0;
   }
   static H5FD_class_t Class()
   {
      H5FD_class_t driver{};
#ifdef H5FD_CLASS_VERSION
      driver.version = H5FD_CLASS_VERSION;
      // Any above those that HDF5 keeps for itself.
      driver.value = static_cast<H5FD_class_value_t>(600);
#endif
      driver.name = "synovia sparse image";
      driver.maxaddr = std::numeric_limits<std::int64_t>::max();
      driver.fc_degree = H5F_CLOSE_WEAK;
      driver.fapl_size = sizeof(SparseHdf5Image *);
      driver.open = Open;
      driver.close = Close;
      driver.get_eoa = GetSize;
      driver.set_eoa = SetSize;
      driver.get_eof = GetSize;
      driver.read = Read;
      driver.write = Write;
      return driver;
   }
};

hid_t SparseHdf5Image::Access()
{
   static const H5FD_class_t driver = File::Class();
   static const hid_t id = H5FDregister(&driver);
   SparseHdf5Image *const self = this;
   const hid_t access = H5Pcreate(H5P_FILE_ACCESS);
   H5Pset_driver(access, id, &self);
   return access;
}

void SparseHdf5Image::Read(std::size_t begin, std::size_t count,
                           char *bytes) const
{
   ForEachPage(begin, count,
               [&](std::size_t number, std::size_t at, std::size_t done,
                   std::size_t here)
               {
                  const auto page = pages.find(number);
                  if (page == pages.end())
                  {
                     std::fill_n(bytes + done, here, '\0');
                  }
                  else
                  {
                     std::copy_n(page->second.begin() + at, here, bytes + done);
                  }
               });
}

void SparseHdf5Image::Write(std::size_t begin, std::size_t count,
                            const char *bytes)
{
   ForEachPage(begin, count,
               [&](std::size_t number, std::size_t at, std::size_t done,
                   std::size_t here)
               {
                  std::vector<char> &page = pages[number];
                  page.resize(page_size, '\0');
                  std::copy_n(bytes + done, here, page.begin() + at);
               });
}

} // namespace synovia
