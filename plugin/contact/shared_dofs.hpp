#pragma once

#include "mfem.hpp"

namespace synovia
{

/// Collective. Sums a vector of local dofs over the ranks that share them; true
/// dofs, on the host, where what belongs to a contact is evaluated.
inline mfem::Vector SumShared(const mfem::ParFiniteElementSpace &space,
                              const mfem::Vector &local)
{
   mfem::Vector result(space.GetTrueVSize());
   space.GetProlongationMatrix()->MultTranspose(local, result);
   result.HostReadWrite();
   result.UseDevice(false);
   return result;
}

/// Collective. The other way: true dofs to the local ones of all ranks.
inline mfem::Vector Share(const mfem::ParFiniteElementSpace &space,
                          const mfem::Vector &true_dofs)
{
   mfem::Vector result(space.GetVSize());
   space.GetProlongationMatrix()->Mult(true_dofs, result);
   result.HostReadWrite();
   result.UseDevice(false);
   return result;
}

} // namespace synovia
