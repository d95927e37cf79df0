#pragma once

#include "synovia/contact/surface_pairing.hpp"

#include <memory>

namespace synovia
{

/// Vertices of the destination at the rim of the source, of whose surroundings
/// it covers but a sliver, without multipliers of their own: on the sliver
/// their shape functions go to the covered vertices around, each by as much as
/// both overlap there. So the functions that multipliers have go on adding up
/// to one wherever the source covers the destination, and a vertex that slides
/// over the rim bears no needle of traction on its way out.
class RimVertices
{
public:
   /// Borrows the surface and its NodalAreas(). A vertex belongs to the rim if
   /// the source covers less than @a rim_coverage of its area.
   RimVertices(const ContactSurface &destination,
               const mfem::Vector &whole_area, mfem::real_t rim_coverage);

   /// Finds them, for the points of @a pairing and the areas around vertices
   /// that these make up. @a least: of each vertex, the part of its area that
   /// must be covered; the same for all if that is empty. Collective.
   void Update(const SurfacePairing &pairing, const mfem::Vector &covered_area,
               const mfem::Vector &least = mfem::Vector());
   /// Such parts which let vertices of the rim stay there, and others stay out
   /// of it, while what is covered does not change by much.
   mfem::Vector KeepingParts(const mfem::Vector &covered_area) const;
   /// The same for vertices that are given: those that are 1 in @a without.
   /// Collective.
   void UpdateThose(const SurfacePairing &pairing, const mfem::Vector &without);

   /// Turns sums over shape functions (an entry, or a row, a vertex) into sums
   /// over the functions of multipliers, zero at the rim. Collective.
   void Gather(mfem::Vector &sums) const;
   void Gather(std::unique_ptr<mfem::HypreParMatrix> &sums) const;
   /// The other way: gives the rim's vertices what those around have.
   /// Collective.
   void Spread(mfem::Vector &values) const;

private:
   const ContactSurface &destination;
   const mfem::Vector &whole_area;
   mfem::real_t rim_coverage;
   /// Functions of multipliers x shape functions; null where both are the same.
   std::unique_ptr<mfem::HypreParMatrix> gathering;
};

} // namespace synovia
