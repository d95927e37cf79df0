#pragma once

#include "synovia/contact/surface_search.hpp"

#include <utility>
#include <vector>

namespace synovia
{

/// Rank that has a face, and its number in that rank's ContactSurface.
using FaceName = std::pair<int, int>;

/// A face as its owner has it now.
struct HaloFace
{
   FaceDofs dofs;
   /// Positions as meshed, and now.
   FacePolynomial reference;
   FacePolynomial shape;
   /// At the nodes of the pressure.
   mfem::Vector pressure;
};

/// Faces of a surface that live on any rank, for a rank that works with them:
/// it asks for them once, and gets their positions and pressures as often as
/// these change.
class FaceHalo
{
public:
   /// Borrows @a surface.
   explicit FaceHalo(const ContactSurface &surface);

   /// Sets which faces this rank works with; they are numbered in the order of
   /// @a names. @a search is one of the surface. UpdateShapes() comes next.
   /// Collective.
   void Ask(const SurfaceSearch &search, const std::vector<FaceName> &names);

   /// Brings positions to the surface's current configuration. Collective.
   void UpdateShapes();
   /// Sets pressures from @a p (true dofs). Collective.
   void UpdatePressures(const mfem::Vector &p);

   const HaloFace &operator[](int i) const { return faces[i]; }

private:
   using ShapeOf = const FacePolynomial &(DeformedFace::*)() const;

   /// Gets a shape of the owners' faces.
   void Fetch(ShapeOf shape_of, FacePolynomial HaloFace::*shape);
   /// Sends the values that @a append adds for each face asked for, and lets
   /// @a take have those of this rank's faces.
   template <typename Append, typename Take>
   void Send(const Append &append, const Take &take);

   const ContactSurface &surface;
   std::vector<HaloFace> faces;
   /// By rank: this rank's faces that it asked for, and where its own that are
   /// asked for here are in faces.
   std::vector<std::vector<int>> asked;
   std::vector<std::vector<int>> mine;
};

} // namespace synovia
