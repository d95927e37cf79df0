#pragma once

#include "synovia/contact/contact_coverage.hpp"
#include "synovia/contact/contact_options.hpp"
#include "synovia/contact/contact_surface.hpp"
#include "synovia/general/solver_tuning.hpp"

#include <array>
#include <memory>

namespace synovia
{

/// Options of search and quadrature between two surfaces.
struct GapOptions
{
   /// Exactness of the quadrature on each segment, the part of a destination
   /// face that one source face covers. The integrands are of the order of the
   /// displacement plus one, where faces are flat.
   int quadrature_order = 5;
   /// How far a destination point looks for the source, on either side
   /// (length).
   mfem::real_t search_radius = 0.0;
   ContactNormal normal = ContactNormal::destination;
   /// See ContactTuning.
   mfem::real_t rim_coverage = ContactTuning().rim_coverage;
};

/// The weighted gap and pressure jump between two surfaces, linear in the
/// fields, with one row for each vertex of the destination:
///
///     g_j = int phi_j n.(x_A - x_B) / a_j = (gap u)_j + gap_offset_j
///     [p]_j = int phi_j (p_A - p_B) / a_j = (jump p)_j,   a_j = int phi_j
///
/// A is the source, B the destination, n the unit normal (GapOptions::normal),
/// x_A the point where it hits A in the current configuration; the integrals
/// run over those points of B, in its reference configuration, that hit. The
/// gap is negative where the surfaces overlap. Rows are zero, and a_j = 0,
/// where nothing is hit. Integration goes segment by segment
/// (SegmentSurface()), so that on flat surfaces the contact patch test holds to
/// round-off, while the integrals stay on one side, which keeps forces and
/// moments of both sides in balance point by point. This is the mortar form of
/// Guo & Spilker's Table 1, stable for displacements of order 2.
struct GapOperators : ContactCoverage
{
   /// Vertices x displacement true dofs, dimensionless.
   std::unique_ptr<mfem::HypreParMatrix> gap;
   /// Vertices x pressure true dofs, dimensionless.
   std::unique_ptr<mfem::HypreParMatrix> jump;
   /// Gap of the undeformed surfaces between the points that see each other
   /// (length).
   mfem::Vector gap_offset;
};

/// Collective. Searches from @a destination to @a source, both in their current
/// configuration, and assembles the operators.
GapOperators AssembleGapOperators(const ContactSurface &source,
                                  const ContactSurface &destination,
                                  const GapOptions &options);

/// Collective. Applies a jump operator to the pressures @a p (true dofs) of
/// both surfaces, and, with the opposite sign, to the destination's pressures
/// alone.
void MultJump(const mfem::HypreParMatrix &map,
              const ContactSurface &destination, const mfem::Vector &p,
              mfem::Vector &jump, mfem::Vector &pressure);

/// Collective. int phi_j over the whole surface, for each of its vertices.
mfem::Vector NodalAreas(const ContactSurface &surface);

} // namespace synovia
