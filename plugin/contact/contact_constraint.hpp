#pragma once

#include "synovia/contact/contact_coverage.hpp"
#include "synovia/contact/contact_factors.hpp"
#include "synovia/general/state_archive.hpp"

#include <string>

namespace synovia
{

/// Gap and pressure jump between the surfaces of a pair as functions of
/// displacement and pressure, with their derivatives. What is done about them
/// is the business of an enforcement.
///
/// All members are collective. Displacements and pressures are true dofs;
/// vectors of gaps and jumps have an entry for each vertex of the destination.
class ContactConstraint
{
public:
   virtual ~ContactConstraint() = default;

   /// Lets the undeformed surfaces search for each other, unless any search
   /// was before. Throws Error if they overlap too deeply.
   virtual void SearchReference() = 0;
   /// Lets the surfaces search for each other at displacement @a u: before the
   /// first Search() for where the run is to start, which stands for the
   /// undeformed configuration then.
   virtual void SearchAt(const mfem::Vector &u) = 0;
   /// Prepares for a stage that is expected to end near @a u; says whether
   /// coverage and factors are others than before. The first call searches the
   /// reference before, unless any search was; it throws Error if nothing is
   /// within the search radius.
   virtual bool Search(const mfem::Vector &u) = 0;

   /// Sets @a gap (length, negative where surfaces overlap), the @a jump of
   /// the pressure, source less destination, and the destination's own
   /// @a pressure (stress), means around the vertices.
   virtual void Evaluate(const mfem::Vector &u, const mfem::Vector &p,
                         mfem::Vector &gap, mfem::Vector &jump,
                         mfem::Vector &pressure) = 0;

   /// At the last search.
   virtual const ContactCoverage &Coverage() const = 0;
   /// The matrices at the last search and Evaluate(), without weights.
   virtual ContactFactors Factors() const = 0;

   /// Lists what later searches and evaluations depend on beside u and p, with
   /// names that begin with @a prefix; reading sets it.
   virtual void Archive(StateArchive &archive, const std::string &prefix) = 0;
};

} // namespace synovia
