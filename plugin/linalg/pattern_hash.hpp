#pragma once

#include "mfem.hpp"

#include <cstdint>

namespace synovia
{

/// A hash of the places of a matrix's entries (FNV-1a).
class PatternHash
{
public:
   /// Of this rank's rows.
   explicit PatternHash(const mfem::HypreParMatrix &matrix)
   {
      mfem::SparseMatrix diagonal;
      mfem::SparseMatrix others;
      HYPRE_BigInt *columns = nullptr;
      matrix.GetDiag(diagonal);
      matrix.GetOffd(others, columns);
      Add(diagonal);
      Add(others);
      Add(columns, others.Width());
   }
   std::uint64_t Value() const { return value; }

private:
   template <typename Index>
   void Add(const Index *indices, int count)
   {
      constexpr std::uint64_t prime = 1099511628211u;
      for (int i = 0; i < count; i++)
      {
         value = (value ^ static_cast<std::uint64_t>(indices[i])) * prime;
      }
   }
   void Add(const mfem::SparseMatrix &part)
   {
      Add(part.HostReadI(), part.Height() + 1);
      Add(part.HostReadJ(), part.NumNonZeroElems());
   }

   std::uint64_t value = 14695981039346656037u;
};

} // namespace synovia
