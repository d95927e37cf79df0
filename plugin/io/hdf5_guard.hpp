#pragma once

// For sources of the library only: who uses it need not have HDF5.

#include <hdf5.h>

#include <stdexcept>
#include <string>

namespace synovia
{

/// Closes an identifier of HDF5 at the end of a scope.
struct Hdf5Guard
{
   hid_t id;
   herr_t (*close)(hid_t);
   ~Hdf5Guard()
   {
      if (id >= 0)
      {
         close(id);
      }
   }
};

inline herr_t KeepInnermost(unsigned, const H5E_error2_t *entry, void *text)
{
   // H5Ewalk2() upwards visits the innermost, most telling, error first.
   std::string &reason = *static_cast<std::string *>(text);
   if (reason.empty() && entry->desc)
   {
      reason = entry->desc;
   }
   return 0;
}

/// Why the last call of HDF5 failed, or nothing.
inline std::string Hdf5Reason()
{
   std::string reason;
   H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, KeepInnermost, &reason);
   return reason;
}

/// What HDF5 returned, an identifier or a status; throws std::runtime_error
/// with the reason if it says that the call failed.
template <typename Status>
Status Verified(Status status)
{
   if (status < 0)
   {
      throw std::runtime_error(Hdf5Reason());
   }
   return status;
}

} // namespace synovia
