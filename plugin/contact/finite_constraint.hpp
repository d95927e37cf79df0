#pragma once

#include "synovia/contact/contact_constraint.hpp"
#include "synovia/contact/contact_geometry.hpp"
#include "synovia/contact/finite_gap.hpp"
#include "synovia/general/solver_tuning.hpp"

namespace synovia
{

/// Gap and jump in finite deformation: surfaces look for each other anew in
/// each stage, unless they have hardly slid since they did, points follow the
/// displacement in between, and derivatives are complete; see FiniteGap. Where
/// points have gone to other faces, HasDrifted() searches, and the next
/// SearchAt() takes what it found. Tractions and fluxes are per reference area
/// of the destination.
///
/// Large because it has all that ContactConstraint asks for.
class FiniteConstraint : public ContactConstraint
{
public:
   /// Borrows @a geometry. @a gap_tolerance: what gaps are closed to (length).
   FiniteConstraint(ContactGeometry &geometry, InitialOverlap initial_overlap,
                    mfem::real_t gap_tolerance, const ContactTuning &tuning);

   void SearchReference() override;
   void SearchAt(const mfem::Vector &u) override;
   void StartStep(const mfem::Vector &u, bool failed) override;
   bool KeepsFound() const override { return keeps; }
   bool Search(const mfem::Vector &u) override;
   void Evaluate(const mfem::Vector &u, const mfem::Vector &p,
                 mfem::Vector &gap, mfem::Vector &jump,
                 mfem::Vector &pressure) override;
   void Remember() override { gaps->Remember(); }
   void GoBack() override { gaps->GoBack(); }
   void StartLinearize(const mfem::Vector &p, const mfem::Vector &nodal_force,
                       const mfem::Vector &nodal_flow) override;
   void IntegrateDerivatives() override;
   bool FinishLinearize() override;
   bool HasDrifted() override;
   void Accept() override;
   const ContactCoverage &Coverage() const override
   {
      return gaps->Operators();
   }
   const mfem::Vector &PresentArea() const override
   {
      return gaps->PresentArea();
   }
   const std::array<mfem::Vector, 3> &PresentNormalArea() const override
   {
      return gaps->PresentNormalArea();
   }
   ContactFactors Factors() const override;
   /// Of the last search; derivatives of the last FinishLinearize().
   const FiniteGap &Gap() const { return *gaps; }
   /// Of the surfaces (true dofs).
   const mfem::Vector &Displacement() const { return displacement; }
   /// Lets the surfaces look for each other at displacement @a u, and leaves
   /// them there: Search() must follow. Collective.
   std::unique_ptr<FiniteGap> FindGap(const mfem::Vector &u);
   void Archive(StateArchive &archive, const std::string &prefix) override;

private:
   /// Of displacements, on all ranks.
   bool AreSame(const mfem::Vector &u, const mfem::Vector &v) const;
   /// Makes points and bearing where former steps had them, or at @a u if
   /// surfaces have slid too far since.
   void TakeKept(const mfem::Vector &u);
   /// Points and bearing at displacement @a at, which follow to @a u.
   void FindKept(const mfem::Vector &at, const mfem::Vector &u);
   /// Finds anew what faces bear; returns what was searched for that.
   std::unique_ptr<FiniteGap> FindBearing(const mfem::Vector &u);
   /// Lets the gaps' points follow the surfaces to displacement @a u.
   void Follow(const mfem::Vector &u);
   /// Not searched yet.
   std::unique_ptr<FiniteGap> MakeGap() const;
   std::unique_ptr<FiniteGap> SearchAnew() const;
   /// Whether gaps or areas are others than ours, on this rank.
   bool Differs(const FiniteGap &other) const;

   ContactGeometry &geometry;
   InitialOverlap initial_overlap;
   mfem::real_t gap_tolerance;
   ContactTuning tuning;
   std::unique_ptr<FiniteGap> gaps;
   /// Searched where the surfaces are; null if none was since they moved.
   std::unique_ptr<FiniteGap> searched_anew;
   bool reached = false;
   KeptBearing bearing;
   /// Displacement at which the next step makes its points and finds what faces
   /// bear; empty if it looks for partners at its first guess.
   mfem::Vector kept_at;
   /// Whether this step has such points.
   bool keeps = false;
   /// Of a step that has not: made where it began, for how far it slides.
   std::unique_ptr<FiniteGap> at_start;
   mfem::Vector displacement;
   /// Whether gaps has derivatives, of where the surfaces are or were.
   bool linearized = false;
   mfem::Vector removed_overlap;
};

} // namespace synovia
