#pragma once

#include "synovia/fem/rigid_motions.hpp"

namespace synovia
{

// Parts of sums of c c^T for what resists rigid motions, of which a row c has
// the factors: matrices of all motions of all bodies.

/// Adds s r r^T for the motions r of one body at a dof.
void AddSquare(const RigidMotions &motions, int dof, mfem::real_t s,
               mfem::DenseMatrix &sum);

/// Adds a part as if its largest entry were 1: however stiff or large it is.
void AddScaled(const mfem::DenseMatrix &part, mfem::DenseMatrix &sum);

/// Adds up the parts of all ranks. Collective.
void SumOverRanks(mfem::DenseMatrix &matrix, MPI_Comm comm);

} // namespace synovia
