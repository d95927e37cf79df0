#pragma once

#include "synovia/contact/contact_constraint.hpp"
#include "synovia/contact/contact_geometry.hpp"

namespace synovia
{

/// Gap and jump that are linear in displacement and pressure from one search to
/// the next; see GapOperators.
class InfinitesimalConstraint : public ContactConstraint
{
public:
   /// Borrows @a geometry.
   InfinitesimalConstraint(ContactGeometry &geometry,
                           SearchConfiguration configuration,
                           InitialOverlap initial_overlap);

   void SearchReference() override;
   void SearchAt(const mfem::Vector &u) override;
   /// In the reference configuration partners hold for good.
   bool Search(const mfem::Vector &u) override;
   void Evaluate(const mfem::Vector &u, const mfem::Vector &p,
                 mfem::Vector &gap, mfem::Vector &jump,
                 mfem::Vector &pressure) override;
   const ContactCoverage &Coverage() const override { return operators; }
   ContactFactors Factors() const override;
   void Archive(StateArchive &archive, const std::string &prefix) override;

private:
   ContactGeometry &geometry;
   SearchConfiguration configuration;
   InitialOverlap initial_overlap;
   GapOperators operators;
   /// Whether the source was found within the search radius, in this run or in
   /// the one that it goes on from.
   bool reached = false;
   bool searched = false;
   /// What is added to the gaps, see InitialOverlap::remove.
   mfem::Vector removed_overlap;
};

} // namespace synovia
