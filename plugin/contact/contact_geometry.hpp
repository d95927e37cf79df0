#pragma once

#include "synovia/contact/contact_scales.hpp"
#include "synovia/contact/gap_operators.hpp"

namespace synovia
{

/// The two surfaces of a contact pair: their positions, their search for each
/// other, and checks of reach and overlap.
class ContactGeometry
{
public:
   /// Collective. Borrows @a spaces. Throws Error that names the @a pair if the
   /// surfaces share a vertex.
   ContactGeometry(const std::string &pair, BiphasicSpaces &spaces,
                   const mfem::Array<int> &source_boundary,
                   const mfem::Array<int> &destination_boundary,
                   const ContactScales &scales, const ContactOptions &options,
                   const ContactTuning &tuning);

   const ContactSurface &Source() const { return source; }
   const ContactSurface &Destination() const { return destination; }
   /// Of the surfaces' vertices, whatever meets them (area).
   const mfem::Vector &SourceAreas() const { return source_areas; }
   const mfem::Vector &DestinationAreas() const { return destination_areas; }
   /// Of the surfaces' nodes at the last SetDisplacement(), in the order of
   /// ContactSurface::DisplacementTrueDofs() (length).
   const mfem::Vector &SourcePositions() const { return source_positions.now; }
   const mfem::Vector &DestinationPositions() const
   {
      return destination_positions.now;
   }

   const GapOptions &Options() const { return options; }

   /// Moves the surfaces to displacement @a u (true dofs). Collective.
   void SetDisplacement(const mfem::Vector &u);
   /// Lets the surfaces search for each other where they are. Vertices of which
   /// the source covers next to nothing are left out. Collective.
   GapOperators Search() const;

   /// Sets the areas of such vertices to zero.
   void LeaveOutSlivers(ContactCoverage &coverage) const;

   /// Throws Error if no vertex sees the source. Collective.
   void VerifyReach(const ContactCoverage &coverage) const;
   /// How deep the vertices that see the source are in it, for a @a gap as
   /// meshed; throws Error if that is beyond the limit. Collective.
   mfem::Vector FindOverlap(const ContactCoverage &coverage,
                            const mfem::Vector &gap) const;

private:
   std::string pair;
   MPI_Comm comm;
   ContactSurface source;
   ContactSurface destination;
   GapOptions options;
   mfem::real_t least_coverage;
   mfem::real_t overlap_limit;
   mfem::Vector source_areas;
   mfem::Vector destination_areas;
   struct Positions
   {
      mfem::Vector reference;
      mfem::Vector now;
   };
   Positions source_positions;
   Positions destination_positions;
};

} // namespace synovia
