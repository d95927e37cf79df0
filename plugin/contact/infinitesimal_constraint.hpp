#pragma once

#include "synovia/contact/contact_constraint.hpp"
#include "synovia/contact/contact_geometry.hpp"

namespace synovia
{

/// Gap and jump that are linear in displacement and pressure from one search to
/// the next; see GapOperators. In the current configuration, surfaces that have
/// slid by less than a part of a face since their operators were found keep
/// these, and gaps follow.
class InfinitesimalConstraint : public ContactConstraint
{
public:
   /// Borrows @a geometry. @a kept_slide: see ContactTuning.
   InfinitesimalConstraint(ContactGeometry &geometry,
                           SearchConfiguration configuration,
                           InitialOverlap initial_overlap,
                           mfem::real_t kept_slide);

   void SearchReference() override;
   void SearchAt(const mfem::Vector &u) override;
   void StartStep(const mfem::Vector &u, bool failed) override;
   /// In the reference configuration partners hold for good.
   bool Search(const mfem::Vector &u) override;
   void Evaluate(const mfem::Vector &u, const mfem::Vector &p,
                 mfem::Vector &gap, mfem::Vector &jump,
                 mfem::Vector &pressure) override;
   const ContactCoverage &Coverage() const override { return operators; }
   ContactFactors Factors() const override;
   void Archive(StateArchive &archive, const std::string &prefix) override;

private:
   void Take(GapOperators found);
   bool SearchCurrent(const mfem::Vector &u);
   /// How far vertices that touch the source at displacement @a u, or nearly
   /// so, have slid on it at most since the operators were found, as a part of
   /// the size of their faces; all that see it if none touches, and infinite if
   /// none sees it. @a now and @a gap: found there.
   mfem::real_t Slid(const GapOperators &now, const mfem::Vector &gap,
                     const mfem::Vector &u) const;
   /// Lets gaps at displacement @a u be those found there, with the operators
   /// as they are.
   void Follow(const GapOperators &now, const mfem::Vector &gap,
               const mfem::Vector &u);

   ContactGeometry &geometry;
   SearchConfiguration configuration;
   InitialOverlap initial_overlap;
   mfem::real_t kept_slide;
   GapOperators operators;
   /// Gaps are this beside what is linear in the displacement: that of the
   /// operators, unless surfaces have slid since.
   mfem::Vector gap_offset;
   /// Whether the source was found within the search radius, in this run or in
   /// the one that it goes on from.
   bool reached = false;
   /// Whether the operators are those of the last Search().
   bool searched = false;
   /// Displacement at which they were found; empty if they are not to be kept.
   mfem::Vector searched_at;
   /// What is added to the gaps, see InitialOverlap::remove.
   mfem::Vector removed_overlap;
};

} // namespace synovia
