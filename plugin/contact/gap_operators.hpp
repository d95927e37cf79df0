#pragma once

#include "contact/contact_surface.hpp"

#include <memory>

namespace synovia
{

/// How two surfaces are held against each other.
struct GapOptions
{
   /// Exactness of the destination's quadrature. Source faces cut through the
   /// destination's, so that no rule is exact: a high one makes the error
   /// small.
   int quadrature_order = 10;
   /// How far a destination point looks for the source, on either side
   /// (length).
   mfem::real_t search_radius = 0.0;
};

/// The weighted gap and pressure jump between two surfaces, linear in the
/// fields, with one row for each vertex of the destination:
///
///     g_j = int phi_j n.(x_A - x_B) / a_j = (gap u)_j + gap_offset_j
///     [p]_j = int phi_j (p_A - p_B) / a_j = (jump p)_j,   a_j = int phi_j
///
/// A is the source, B the destination, n the outward unit normal of B in the
/// current configuration, x_A the point where the normal hits A; the integrals
/// run over those points of B, in its reference configuration, that hit. The
/// gap is negative where the surfaces overlap. Rows are zero, and a_j = 0,
/// where nothing is hit. This is the mortar form of Guo & Spilker's Table 1,
/// stable for displacements of order 2.
struct GapOperators
{
   /// Multiplier x displacement true dofs, dimensionless.
   std::unique_ptr<mfem::HypreParMatrix> gap;
   /// Multiplier x pressure true dofs, dimensionless.
   std::unique_ptr<mfem::HypreParMatrix> jump;
   /// Source vertices x destination vertices (both as multiplier true dofs):
   /// int psi_k phi_j, area of source vertex k that destination vertex j
   /// covers.
   std::unique_ptr<mfem::HypreParMatrix> coverage;
   /// Gap of the undeformed surfaces along the current normals (length).
   mfem::Vector gap_offset;
   /// a_j (area).
   mfem::Vector area;
   /// Mean size of the destination faces around a vertex (length).
   mfem::Vector face_size;
};

/// Collective. Searches from @a destination to @a source, both in their current
/// configuration, and assembles the operators.
GapOperators AssembleGapOperators(const ContactSurface &source,
                                  const ContactSurface &destination,
                                  const GapOptions &options);

/// Collective. int phi_j over the whole surface, for each multiplier true dof.
mfem::Vector NodalAreas(const ContactSurface &surface);

} // namespace synovia
