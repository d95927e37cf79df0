#pragma once

#include "mfem.hpp"

#include <cstdint>

namespace synovia
{

/// A hash of the places of a matrix's entries (FNV-1a).
class PatternHash
{
public:
   explicit PatternHash(const mfem::SparseMatrix &matrix)
   {
      Add(matrix.HostReadI(), matrix.Height() + 1);
      Add(matrix.HostReadJ(), matrix.NumNonZeroElems());
   }
   std::uint64_t Value() const { return value; }

private:
   void Add(const int *indices, int count)
   {
      constexpr std::uint64_t prime = 1099511628211u;
      for (int i = 0; i < count; i++)
      {
         value = (value ^ static_cast<std::uint64_t>(indices[i])) * prime;
      }
   }

   std::uint64_t value = 14695981039346656037u;
};

} // namespace synovia
