#pragma once

#include "synovia/contact/gap_operators.hpp"
#include "synovia/contact/sliding_maps.hpp"

#include <memory>

namespace synovia
{

/// What else moves the nodes of a tie's surfaces, or drains them, as ascending
/// true dofs: multipliers would be too many where a node of the destination is
/// not free to follow the source.
struct TieHolds
{
   /// Of the displacement.
   mfem::Array<int> prescribed;
   /// Of the displacement: moved by something else that is not known before,
   /// such as a rigid body or another tie.
   mfem::Array<int> moved;
   /// Of the pressure, likewise.
   mfem::Array<int> prescribed_pressures;
   mfem::Array<int> moved_pressures;
};

/// The jumps of displacement and pressure between two undeformed surfaces, with
/// one row for each vertex j of the destination:
///
///     [u_c]_j = int psi_j (u_A - u_B)_c dA / a_j,   a_j = int psi_j dA
///     [p]_j = int psi_j (p_A - p_B) dA / a_j
///
/// A is the source, B the destination; the integrals run over those points of B
/// whose normal hits A. psi_j, of its own for each component and the pressure,
/// is the shape function of the vertex. A vertex that is held, or of whose
/// surroundings A covers but a sliver, gives its function to those around
/// (RimVertices): the functions add up to one wherever A covers B, so that
/// constant tractions are kept.
struct TieOperators
{
   /// By component, vertices x displacement true dofs (dimensionless).
   MatrixByComponent jump;
   /// a_j; 0 where there is nothing to tie.
   VectorByComponent area;
   /// Vertices x pressure true dofs (dimensionless), and a_j.
   std::unique_ptr<mfem::HypreParMatrix> pressure_jump;
   mfem::Vector pressure_area;
   /// A matrix of that size without entries.
   std::unique_ptr<mfem::HypreParMatrix> no_jump;
   /// Mean size of the destination faces around a vertex (length).
   mfem::Vector face_size;
   /// Part of the destination's area that the source covers.
   mfem::real_t covered = 0.0;
   /// Largest distance between points that are tied (length).
   mfem::real_t distance = 0.0;
};

/// Collective. @a options.normal must be the destination's. @a areas are
/// NodalAreas() of the destination. Without @a exchange no pressures are tied.
TieOperators AssembleTieOperators(const ContactSurface &source,
                                  const ContactSurface &destination,
                                  const mfem::Vector &areas,
                                  const GapOptions &options,
                                  const TieHolds &holds, bool exchange);

} // namespace synovia
