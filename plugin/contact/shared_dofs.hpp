#pragma once

#include "mfem.hpp"

namespace synovia
{

/// Collective. Sums a vector of local dofs over the ranks that share them; true
/// dofs, on the host, where what belongs to a contact is evaluated.
inline mfem::Vector SumShared(const mfem::ParFiniteElementSpace &space,
                              const mfem::Vector &local)
{
   // The operator may take what it reads to a device; the caller goes on
   // writing to his own on the host.
   const mfem::Vector read(local);
   mfem::Vector result(space.GetTrueVSize());
   space.GetProlongationMatrix()->MultTranspose(read, result);
   result.HostReadWrite();
   result.UseDevice(false);
   return result;
}

/// Collective. The other way: true dofs to the local ones of all ranks.
inline mfem::Vector Share(const mfem::ParFiniteElementSpace &space,
                          const mfem::Vector &true_dofs)
{
   const mfem::Vector read(true_dofs);
   mfem::Vector result(space.GetVSize());
   space.GetProlongationMatrix()->Mult(read, result);
   result.HostReadWrite();
   result.UseDevice(false);
   return result;
}

} // namespace synovia
