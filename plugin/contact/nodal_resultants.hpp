#pragma once

#include "synovia/general/point3.hpp"

#include "mfem.hpp"

namespace synovia
{

/// Resultant of the nodal forces at some true dofs of the displacement (force).
/// Collective.
Point3 SumOfDofs(const mfem::Vector &force, const mfem::Array<int> &dofs,
                 MPI_Comm comm);

/// Their moment about the origin (force x length), with the @a positions of
/// these dofs, in order, of which the three of a node follow each other
/// (length). Collective.
Point3 SumOfMoments(const mfem::Vector &force, const mfem::Vector &positions,
                    const mfem::Array<int> &dofs, MPI_Comm comm);

/// Collective.
Point3 SumOverRanks(Point3 value, MPI_Comm comm);

} // namespace synovia
