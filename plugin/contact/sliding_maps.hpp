#pragma once

#include "mfem.hpp"

#include <array>
#include <memory>

namespace synovia
{

/// By component of space.
using MatrixByComponent = std::array<std::unique_ptr<mfem::HypreParMatrix>, 3>;
using VectorByComponent = std::array<mfem::Vector, 3>;

/// What friction needs of the points of a FiniteGap: means around each vertex j
/// of the destination,
///
///     d_j = int phi_j (x_A - x_B) dA / a_j,
///     P_j = int phi_j p_B da / a_j,
///
/// with the points x_A of the source that faced the points x_B of the
/// destination there, the pressure p_B per present area da, and a_j and dA as
/// in FiniteGap. Nodal forces of tangential tractions t are D^T (a t).
struct SlidingMaps
{
   /// D: d_j as a function of the displacement, while each x_A is the same
   /// material point, m x displacement (dimensionless).
   MatrixByComponent distance;
   /// d_j where the surfaces are (length).
   VectorByComponent mean_distance;
   /// P_j as a function of the pressure, m x pressure (dimensionless).
   std::unique_ptr<mfem::HypreParMatrix> pressure;
};

/// Derivatives by the displacement.
struct SlidingChanges
{
   /// Of int phi_j n dA, m x displacement (length).
   MatrixByComponent normal_area;
   /// Of P_j at fixed pressures, m x displacement (stress / length).
   std::unique_ptr<mfem::HypreParMatrix> pressure;
   /// Of D^T (a t) at fixed t, displacement x displacement (force / length).
   std::unique_ptr<mfem::HypreParMatrix> force;
};

} // namespace synovia
