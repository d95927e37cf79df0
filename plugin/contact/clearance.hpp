#pragma once

#include "synovia/contact/contact_pair.hpp"

#include <limits>

namespace synovia
{

/// How far a motion can go until a pair touches.
struct Clearance
{
   /// Multiples of the motion (length, where it is of unit length) until the
   /// first vertex touches, with the motion and against it; negative where the
   /// surfaces overlap, infinite where they don't see each other or the motion
   /// doesn't bring them together.
   mfem::real_t ahead = std::numeric_limits<mfem::real_t>::infinity();
   mfem::real_t behind = std::numeric_limits<mfem::real_t>::infinity();
   /// Whether a vertex ahead is as near as surfaces in contact are.
   bool touches = false;

   void TakeLess(const Clearance &other);
};

/// From the pair's last search and Evaluate(). @a motion are true dofs of the
/// displacement, a translation by 1 of one of the surfaces. Collective.
Clearance FindClearance(const ContactPair &pair, const mfem::Vector &motion);

} // namespace synovia
