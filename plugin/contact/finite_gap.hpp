#pragma once

#include "synovia/contact/gap_derivatives.hpp"
#include "synovia/contact/sliding_maps.hpp"
#include "synovia/general/parallel_triplets.hpp"

#include <memory>

namespace synovia
{

/// What surfaces keep within a time step, lest searches undo each other: what
/// faces bear (BearingShares()), and what part of each vertex's area must be
/// covered for it not to belong to the rim (RimVertices). Empty: everything,
/// and the part of GapOptions.
struct KeptBearing
{
   FaceShares shares;
   mfem::Vector least_coverage;
};

/// Gap and pressure jump between two surfaces in finite deformation, with
/// complete derivatives:
///
///     g_j = int phi_j n.(x_A - x_B) dA / a_j,
///     [p]_j = int phi_j (p_A - p_B) dA / a_j,   a_j = int phi_j dA
///
/// A is the source, B the destination, n the unit normal of B in its current
/// configuration (SurfaceNormals), x_A where it hits A there; the integrals run
/// over those material points of B, with their reference areas dA, that hit.
/// Tractions and fluxes that go with these are nominal, per reference area of
/// B. phi_j are the functions of RimVertices, less where the surfaces turn away
/// from each other (BearingShares()). Nodal forces act along n on both
/// sides, so that forces and moments are in balance point by point; they are no
/// gradient of the gap, so that the derivatives aren't symmetric.
///
/// Vectors have an entry for each vertex of the destination. All members are
/// collective but those that return what is there.
class FiniteGap
{
public:
   /// Borrows both surfaces, and the NodalAreas() of the destination.
   FiniteGap(const ContactSurface &source, const ContactSurface &destination,
             const mfem::Vector &destination_areas, const GapOptions &options);

   /// Lets the surfaces look for each other anew where they are now.
   void Search(const KeptBearing &kept = KeptBearing());
   /// What is to be kept for a step from where the surfaces are; they must have
   /// searched with nothing kept. An angle of pi or more: faces bear
   /// everything.
   KeptBearing FindBearing(mfem::real_t bearing_angle) const;
   /// Lets the points of the last search follow to where the surfaces are now.
   void Follow();
   /// Remembers what the points hit now, for GoBack().
   void Remember() { pairing.Remember(); }
   /// Lets the points hit what they did at the last Remember(), since when
   /// there was no Search(). Follow() comes next.
   void GoBack();
   /// Where the surfaces were last, once they are made.
   const GapDerivatives &Derivatives() const { return derivatives; }
   GapDerivatives &Derivatives() { return derivatives; }

   /// Of the points where the surfaces were last.
   SlidingMaps FindSlidingMaps() const;
   /// There, for pressures @a p (true dofs) and nodal forces area x tangential
   /// traction.
   SlidingChanges
   FindSlidingChanges(const mfem::Vector &p,
                      const VectorByComponent &nodal_force) const;

   /// The points of the last Search(), and how far they have gone since.
   const SurfacePairing &Pairing() const { return pairing; }

   /// gap and jump of these are the maps G and J of nodal forces and flows;
   /// gap_offset is not used. Areas are undeformed ones, except face_coverage,
   /// which has current areas at the last Search().
   const GapOperators &Operators() const { return operators; }
   GapOperators &Operators() { return operators; }
   /// g_j (length).
   const mfem::Vector &Gap() const { return gap; }
   /// int phi_j da and int phi_j n da in the current configuration (area).
   const mfem::Vector &PresentArea() const { return present_area; }
   const std::array<mfem::Vector, 3> &PresentNormalArea() const
   {
      return present_normal_area;
   }

private:
   /// What the points cover, of which faces bear @a shares (area).
   mfem::Vector CoveredArea(const FaceShares &shares) const;
   /// What the points cover, and which vertices that leaves at the rim.
   void CoverRim();
   /// Values and maps of forces and flows.
   void Assemble();
   /// What only changes with the points.
   void AssembleCoverage();
   /// Sums over shape functions, a row a vertex, as means of the functions of
   /// multipliers.
   std::unique_ptr<mfem::HypreParMatrix>
   AssembleRows(const std::vector<Triplet> &entries,
                mfem::ParFiniteElementSpace &columns) const;

   BiphasicSpaces &spaces;
   SurfacePairing pairing;
   RimVertices rim;
   /// As KeptBearing has it.
   mfem::Vector least_coverage;
   GapOperators operators;
   mfem::Vector gap;
   /// 1 / a_j, 0 where nothing is hit.
   mfem::Vector inverse_area;
   mfem::Vector present_area;
   std::array<mfem::Vector, 3> present_normal_area;
   GapDerivatives derivatives;
};

} // namespace synovia
