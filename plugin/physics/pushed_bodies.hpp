#pragma once

#include "synovia/contact/contact_pair.hpp"
#include "synovia/general/load_curve.hpp"

#include <set>
#include <string>
#include <vector>

namespace synovia
{

/// Bodies that a force moves and that nothing but contact holds along it: it
/// may move them rigidly, without strain, until they touch.
struct PushedBodies
{
   /// The surface that the force moves.
   std::string name;
   std::set<int> bodies;
   /// The unit vector that the force pushes along at first, and the resultant
   /// in this direction.
   Point3 along;
   mfem::real_t sense = 1.0;
   LoadCurve curve{0.0};
   /// By 1 along it, true dofs of the displacement.
   mfem::Vector translation;

   bool PushesAt(mfem::real_t t) const { return sense * curve(t) > 0.0; }

   /// Whether contact holds them, as the pairs' active sets are. Collective.
   bool AreHeldBy(const std::vector<ContactPair *> &pairs) const;

   /// How far they can go until the nearest pair touches; infinite where the
   /// pairs, as they were searched and evaluated last, see nothing ahead.
   /// Collective.
   mfem::real_t Clearance(const std::vector<ContactPair *> &pairs) const;
};

} // namespace synovia
