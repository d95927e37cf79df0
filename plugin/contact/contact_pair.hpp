#pragma once

#include "synovia/contact/augmented_lagrangian.hpp"
#include "synovia/contact/contact_geometry.hpp"
#include "synovia/materials/deformation.hpp"

#include <memory>
#include <string>

namespace synovia
{

/// Two surfaces that may come into contact: their geometry, the constraint on
/// gap and pressure jump, and what enforces it, put together into what the
/// pair adds to the balance of momentum and mass.
///
/// Biphasic; see FrictionlessLaw, and ContactFriction. Vectors have an entry
/// for each of this rank's vertices of the destination (SurfaceVertices): pairs
/// are as large as their surfaces, whatever the mesh.
///
/// Large because it offers its parts as well as what they make together.
class ContactPair
{
public:
   /// Collective. Borrows @a spaces and @a materials. Throws Error if the two
   /// sides share a vertex, if a side has no faces, or on options out of range.
   /// In finite @a deformation surfaces look for each other in the deformed
   /// configuration, and gaps are along the destination's normal there.
   ContactPair(const std::string &name, BiphasicSpaces &spaces,
               const MaterialTable &materials,
               const mfem::Array<int> &source_boundary,
               const mfem::Array<int> &destination_boundary,
               const ContactOptions &options,
               Deformation deformation = Deformation::infinitesimal,
               const ContactTuning &tuning = ContactTuning());

   const std::string &Name() const { return name; }
   const ContactScales &Scales() const { return scales; }
   const ContactGeometry &Geometry() const { return geometry; }
   const ContactConstraint &Constraint() const { return *constraint; }
   /// Multipliers, penalties, active set: its steps are the caller's to take.
   AugmentedLagrangian &Enforcement() { return enforcement; }
   const AugmentedLagrangian &Enforcement() const { return enforcement; }
   const ContactState &State() const { return enforcement.State(); }

   /// As ContactConstraint has them. Collective.
   void SearchReference() { constraint->SearchReference(); }
   void SearchAt(const mfem::Vector &u) { constraint->SearchAt(u); }
   void StartStep(const mfem::Vector &u, bool failed)
   {
      constraint->StartStep(u, failed);
   }
   bool KeepsFound() const { return constraint->KeepsFound(); }
   bool Search(const mfem::Vector &u);
   void Remember() { constraint->Remember(); }
   void GoBack() { constraint->GoBack(); }
   bool HasDrifted() { return constraint->HasDrifted(); }
   /// Brings the derivatives among Factors() to the last tractions and fluxes,
   /// and pressures @a p, in the steps of ContactConstraint.
   void StartLinearize(const mfem::Vector &p);
   void IntegrateDerivatives() { constraint->IntegrateDerivatives(); }
   bool FinishLinearize(const mfem::Vector &p);

   /// Sets 1 in @a sealed (multiplier true dofs) for the vertices of either
   /// surface that this pair seals: none if one of them has no fluid and drains
   /// the other. Collective.
   void MarkSealed(mfem::Vector &sealed) const;

   /// Adds the nodal contact forces to @a momentum (force), and the fluid that
   /// contact moves out of the nodes to @a mass (volume / time). Collective.
   void AddForces(mfem::Vector &momentum, mfem::Vector &mass) const;
   /// Adds |G|^T W |R| u to @a momentum and |J|^T W_p |J| p to @a mass, for
   /// vectors of absolute values: what round-off is relative to. Collective.
   void AddMagnitudes(const mfem::Vector &u, const mfem::Vector &p,
                      mfem::Vector &momentum, mfem::Vector &mass) const;
   /// How the multipliers change by a Newton step of displacement and pressure
   /// (true dofs), beside the penalties by @a forces (area x traction) and
   /// @a outflows (area x flux) of vertices, which are empty if these were not
   /// solved for. Collective.
   MultiplierStep FindMultiplierStep(const mfem::Vector &du,
                                     const mfem::Vector &dp,
                                     const mfem::Vector &forces,
                                     const mfem::Vector &outflows) const;
   /// Of the linearized equations at the last UpdateActiveSet(). Searched.
   ContactFactors Factors() const;

   /// Lists the accepted state; reading sets it. Collective.
   void Archive(StateArchive &archive);

private:
   std::string name;
   mfem::real_t source_sealing_coverage;
   ContactScales scales;
   bool drains;
   ContactGeometry geometry;
   std::unique_ptr<ContactConstraint> constraint;
   AugmentedLagrangian enforcement;
};

} // namespace synovia
