#pragma once

#include "synovia/contact/contact_constraint.hpp"
#include "synovia/contact/contact_geometry.hpp"
#include "synovia/contact/finite_gap.hpp"

namespace synovia
{

/// Gap and jump in finite deformation: surfaces look for each other anew in
/// each stage, points follow the displacement in between, and Linearize() gives
/// complete derivatives; see FiniteGap. Tractions and fluxes are per reference
/// area of the destination.
class FiniteConstraint : public ContactConstraint
{
public:
   /// Borrows @a geometry.
   FiniteConstraint(ContactGeometry &geometry, InitialOverlap initial_overlap);

   void SearchReference() override;
   void SearchAt(const mfem::Vector &u) override;
   bool Search(const mfem::Vector &u) override;
   void Evaluate(const mfem::Vector &u, const mfem::Vector &p,
                 mfem::Vector &gap, mfem::Vector &jump,
                 mfem::Vector &pressure) override;
   bool Linearize(const mfem::Vector &p, const mfem::Vector &nodal_force,
                  const mfem::Vector &nodal_flow) override;
   bool HasDrifted() const override { return gaps.HasDrifted(); }
   const ContactCoverage &Coverage() const override { return gaps.Operators(); }
   const mfem::Vector &PresentArea() const override
   {
      return gaps.PresentArea();
   }
   const std::array<mfem::Vector, 3> &PresentNormalArea() const override
   {
      return gaps.PresentNormalArea();
   }
   ContactFactors Factors() const override;
   void Archive(StateArchive &archive, const std::string &prefix) override;

private:
   ContactGeometry &geometry;
   InitialOverlap initial_overlap;
   FiniteGap gaps;
   bool reached = false;
   /// Of the surfaces (true dofs).
   mfem::Vector displacement;
   /// Whether gaps has the derivatives of where the surfaces are.
   bool linearized = false;
   mfem::Vector removed_overlap;
};

} // namespace synovia
