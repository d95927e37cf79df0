#pragma once

#include "mfem.hpp"

#include <memory>
#include <vector>

namespace synovia
{

/// An entry of a distributed matrix by its global row and column.
struct Triplet
{
   HYPRE_BigInt row;
   HYPRE_BigInt column;
   mfem::real_t value;
};

/// Collective. Builds a matrix from entries that may come from any rank and
/// are added up where they meet.
///
/// @param triplets      this rank's entries; may be empty
/// @param row_offsets   as ParFiniteElementSpace::GetTrueDofOffsets() has them
/// @param rows          global number of rows
/// @param column_offsets, columns   likewise
std::unique_ptr<mfem::HypreParMatrix>
AssembleTriplets(MPI_Comm comm, const std::vector<Triplet> &triplets,
                 HYPRE_BigInt *row_offsets, HYPRE_BigInt rows,
                 HYPRE_BigInt *column_offsets, HYPRE_BigInt columns);

} // namespace synovia
