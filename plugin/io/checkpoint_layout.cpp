#include "synovia/io/checkpoint_layout.hpp"
#include "synovia/io/checkpoint_groups.hpp"
#include "synovia/io/hdf5_guard.hpp"
#include "synovia/io/sparse_hdf5_image.hpp"

namespace synovia
{

namespace
{
namespace groups = checkpoint_groups;

hid_t MakeGroup(hid_t file, const char *name)
{
   return Verified(
      H5Gcreate2(file, name, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT));
}

hid_t MakeSet(hid_t group, const std::string &name, hid_t type, hsize_t count,
              hid_t properties)
{
   const Hdf5Guard space{H5Screate_simple(1, &count, nullptr), H5Sclose};
   return Verified(H5Dcreate2(group, name.c_str(), type, space.id, H5P_DEFAULT,
                              properties, H5P_DEFAULT));
}

void WriteValues(hid_t group, const std::string &name, hid_t file_type,
                 hid_t memory_type, hsize_t count, const void *values)
{
   const Hdf5Guard set{MakeSet(group, name, file_type, count, H5P_DEFAULT),
                       H5Dclose};
   if (count > 0)
   {
      Verified(
         H5Dwrite(set.id, memory_type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values));
   }
}

/// Makes the data sets of fields, whose values HDF5 does not get; returns where
/// they are to be.
std::map<std::string, std::size_t>
MakeFields(hid_t group, const std::map<std::string, std::size_t> &sizes)
{
   const Hdf5Guard properties{H5Pcreate(H5P_DATASET_CREATE), H5Pclose};
   H5Pset_alloc_time(properties.id, H5D_ALLOC_TIME_EARLY);
   H5Pset_fill_time(properties.id, H5D_FILL_TIME_NEVER);
   std::map<std::string, std::size_t> begins;
   for (const auto &[name, size] : sizes)
   {
      const Hdf5Guard set{
         MakeSet(group, name, H5T_NATIVE_DOUBLE, size, properties.id),
         H5Dclose};
      if (size > 0)
      {
         begins[name] = H5Dget_offset(set.id);
      }
   }
   return begins;
}

std::map<std::string, std::size_t> Fill(SparseHdf5Image &image,
                                        const CheckpointContents &contents)
{
   const Hdf5Guard access{image.Access(), H5Pclose};
   constexpr hsize_t any_size = 1;
   H5Pset_alignment(access.id, any_size, sizeof(double));
   const Hdf5Guard file{
      Verified(H5Fcreate("checkpoint", H5F_ACC_TRUNC, H5P_DEFAULT, access.id)),
      H5Fclose};
   const Hdf5Guard texts{MakeGroup(file.id, groups::texts), H5Gclose};
   const Hdf5Guard numbers{MakeGroup(file.id, groups::numbers), H5Gclose};
   const Hdf5Guard fields{MakeGroup(file.id, groups::fields), H5Gclose};
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
   return MakeFields(fields.id, contents.field_sizes);
}
} // namespace

CheckpointLayout::CheckpointLayout(const CheckpointContents &contents)
{
   H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
   SparseHdf5Image image;
   field_begins = Fill(image, contents);
   size = image.Size();
   std::map<std::size_t, std::size_t> field_ends;
   for (const auto &[name, begin] : field_begins)
   {
      field_ends[begin] =
         begin + contents.field_sizes.at(name) * sizeof(double);
   }
   field_ends[size] = size;
   std::size_t begin = 0;
   for (const auto &[field_begin, field_end] : field_ends)
   {
      if (field_begin > begin)
      {
         pieces.push_back({begin, std::vector<char>(field_begin - begin)});
         image.Read(begin, pieces.back().bytes.size(),
                    pieces.back().bytes.data());
      }
      begin = field_end;
   }
}

} // namespace synovia
