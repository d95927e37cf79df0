#pragma once

#include "mfem.hpp"

#include <string>

namespace synovia
{

/// The direction in which gaps are measured and tractions act. Normals are
/// those of the reference configuration, as the theory of small strains has it:
/// with normals that follow the deformation, but without the geometric
/// stiffness that belongs to them, surfaces buckle as soon as the traction gets
/// near the shear modulus.
enum class ContactNormal
{
   /// The destination's normal.
   destination,
   /// The mean of the destination's normal and the opposite of the source's at
   /// the point found: the same whichever surface is the destination, up to the
   /// gap times the curvature.
   mean
};

/// The configuration in which the surfaces look for each other.
enum class SearchConfiguration
{
   /// The undeformed one, once: the linear theory of small displacements to the
   /// letter. Contact is then linear but for its inequalities.
   reference,
   /// The deformed one, anew in every step: for sliding that is not small
   /// beside the contact. Points change partners without the geometric
   /// stiffness that belongs to it, so that thin layers under a traction of
   /// several times their shear modulus may buckle.
   current
};

/// What becomes of surfaces that overlap as meshed.
enum class InitialOverlap
{
   /// The first step presses the overlap out, which strains the bodies.
   press_out,
   /// Gaps are measured from the overlap: vertices of the destination that
   /// overlap start as if they just touched.
   remove
};

/// Coulomb's friction on the share of the load that the solids bear; see
/// FrictionLaw. Only in finite deformation.
struct FrictionOptions
{
   /// mu_eq, without fluid pressure. 0: frictionless.
   mfem::real_t coefficient = 0.0;
   /// phi, the part of the contact area where solid meets solid, at most 1.
   /// 0: derived, the product of the solid fractions on both sides.
   mfem::real_t solid_fraction = 0.0;
};

/// What a side without fluid is to the fluid of the other one where they touch.
enum class DryPartner
{
   /// None passes.
   impermeable,
   /// It leaves without resistance, as where nothing touches.
   draining
};

/// How contact is enforced. Zero means: derived from the bodies.
struct ContactOptions
{
   /// eta (stress / length). Derived: penalty_factor x H_A / h of the softer
   /// side, h being the size of the destination's faces around a vertex; more
   /// where the source covers only a part of what belongs to the vertex.
   mfem::real_t penalty = 0.0;
   /// eta_p (flux / stress). Derived: penalty_factor x (kappa / h + h / (H_A
   /// dt)), of the less permeable and of the softer side: what an element
   /// resists by flow and, in a short step, by its volume.
   mfem::real_t pressure_penalty = 0.0;
   /// Results must not depend on it, iteration counts may.
   mfem::real_t penalty_factor = 100.0;
   /// Largest gap left between surfaces in contact (length). Derived: 1e-5 of
   /// the destination layer's thickness.
   mfem::real_t gap_tolerance = 0.0;
   /// Largest pressure jump left, as a fraction of the peak pressure.
   mfem::real_t pressure_tolerance = 1e-3;
   /// How far the destination looks for the source (length). Derived: the
   /// destination layer's thickness.
   mfem::real_t search_radius = 0.0;
   SearchConfiguration configuration = SearchConfiguration::reference;
   InitialOverlap initial_overlap = InitialOverlap::press_out;
   /// A deeper one is an error (length). Derived: a tenth of the destination
   /// layer's thickness.
   mfem::real_t overlap_limit = 0.0;
   ContactNormal normal = ContactNormal::destination;
   /// Without effect where both sides have fluid, which passes between them.
   DryPartner dry_partner = DryPartner::impermeable;
   /// Exactness of the quadrature on each segment, the part of a destination
   /// face that one source face covers.
   int quadrature_order = 5;
   FrictionOptions friction;
};

/// Throws Error that names the @a pair and the option which is out of range.
void Verify(const ContactOptions &options, const std::string &pair);

} // namespace synovia
