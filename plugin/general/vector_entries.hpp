#pragma once

#include "mfem.hpp"

namespace synovia
{

/// @a list, to be read on the host.
inline const mfem::Array<int> &OnHost(const mfem::Array<int> &list)
{
   list.HostRead();
   return list;
}

/// to_i = from_i for the i of a list, where MFEM's device has the vectors.
inline void CopyEntries(const mfem::Array<int> &entries,
                        const mfem::Vector &from, mfem::Vector &to)
{
   const int *places = entries.Read();
   const mfem::real_t *source = from.Read();
   mfem::real_t *destination = to.ReadWrite();
   mfem::forall(entries.Size(), [=] MFEM_HOST_DEVICE(int i)
                { destination[places[i]] = source[places[i]]; });
}

/// Multiplies the entries from @a begin on, where they are.
inline void ScaleFrom(int begin, mfem::real_t factor, mfem::Vector &x)
{
   mfem::real_t *entries = x.ReadWrite();
   mfem::forall(x.Size() - begin,
                [=] MFEM_HOST_DEVICE(int i) { entries[begin + i] *= factor; });
}

} // namespace synovia
