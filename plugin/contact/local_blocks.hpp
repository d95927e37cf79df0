#pragma once

#include "synovia/general/parallel_triplets.hpp"

#include <vector>

namespace synovia
{

/// Adds sign x the columns of @a block from @a first on to the entries of a
/// distributed matrix, one for each of @a columns.
inline void AppendBlock(mfem::real_t sign, const mfem::DenseMatrix &block,
                        const std::vector<HYPRE_BigInt> &rows, int first,
                        const std::vector<HYPRE_BigInt> &columns,
                        std::vector<Triplet> &triplets)
{
   for (std::size_t j = 0; j < columns.size(); j++)
   {
      for (std::size_t i = 0; i < rows.size(); i++)
      {
         const mfem::real_t value =
            block(static_cast<int>(i), first + static_cast<int>(j));
         if (value != 0.0)
         {
            triplets.push_back({rows[i], columns[j], sign * value});
         }
      }
   }
}

} // namespace synovia
