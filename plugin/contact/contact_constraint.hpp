#pragma once

#include "synovia/contact/contact_coverage.hpp"
#include "synovia/contact/contact_factors.hpp"
#include "synovia/general/state_archive.hpp"

#include <array>
#include <string>

namespace synovia
{

/// Gap and pressure jump between the surfaces of a pair as functions of
/// displacement and pressure, with their derivatives. AugmentedLagrangian
/// enforces it. Large because it goes from the search to the derivatives.
///
/// Members are collective, but one. Displacements and pressures are true dofs;
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
   /// Takes what is kept within a time step from the displacement @a u at its
   /// start; @a failed says whether the last solve failed. A Search() must
   /// follow.
   virtual void StartStep(const mfem::Vector & /*u*/, bool /*failed*/) {}
   /// Whether Search() takes what former steps have found, wherever u is.
   virtual bool KeepsFound() const { return false; }
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

   /// Remembers what the surfaces hit at the last Evaluate(), for GoBack().
   virtual void Remember() {}
   /// Lets them hit what they did at the last Remember(), since when there was
   /// no search: what they hit depends on the displacements that were evaluated
   /// in between. An Evaluate() must follow.
   virtual void GoBack() {}

   /// Brings the derivatives among Factors() to the last Evaluate(), for
   /// pressure @a p (true dofs), nodal forces area x traction and nodal flows
   /// area x flux, in the steps of GapDerivatives, of which the second is not
   /// collective; the last one says whether they are others than before, which
   /// they never are where the constraint is linear.
   virtual void StartLinearize(const mfem::Vector & /*p*/,
                               const mfem::Vector & /*nodal_force*/,
                               const mfem::Vector & /*nodal_flow*/)
   {
   }
   virtual void IntegrateDerivatives() {}
   virtual bool FinishLinearize() { return false; }
   /// Whether another search where the surfaces were evaluated last would find
   /// other gaps, by more than a part of their tolerance, or other areas.
   virtual bool HasDrifted() { return false; }
   /// The state after the last Evaluate() is that of the end of a step.
   virtual void Accept() {}

   /// At the last search. Areas are those that tractions and fluxes refer to,
   /// but for what is covered of a face, which is its present area.
   virtual const ContactCoverage &Coverage() const = 0;
   /// int phi_j and int phi_j n, by component, over present areas (area).
   virtual const mfem::Vector &PresentArea() const { return Coverage().area; }
   virtual const std::array<mfem::Vector, 3> &PresentNormalArea() const
   {
      return Coverage().normal_area;
   }
   /// The matrices at the last search and Evaluate(), without weights;
   /// derivatives by the displacement at the last FinishLinearize().
   virtual ContactFactors Factors() const = 0;

   /// Lists what later searches and evaluations depend on beside u and p, with
   /// names that begin with @a prefix; reading sets it.
   virtual void Archive(StateArchive &archive, const std::string &prefix) = 0;
};

} // namespace synovia
