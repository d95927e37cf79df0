#pragma once

#include "synovia/checks/contact_check.hpp"

#include <vector>

namespace synovia
{

/// One surface of a contact pair, where it may meet the other.
struct ContactSide
{
   /// Mean edge of its faces, by area (length); 0 if none may meet the other.
   mfem::real_t edge = 0.0;
   /// The least aggregate modulus behind it (stress).
   mfem::real_t modulus = 0.0;
   /// If its faces are flat, their mean distance from the smooth surface
   /// through their corners; else 0. Sharp edges count nothing.
   mfem::real_t sagitta = 0.0;

   /// Of a surface that such faces with such edges miss so: h^2 / (8 s).
   mfem::real_t Radius() const { return edge * edge / (8.0 * sagitta); }
};

struct ContactSides
{
   ContactSide source;
   ContactSide destination;
};

/// The sides of the pairs of a case that CheckContact() found. Collective.
std::vector<ContactSides>
MeasureContactSides(const CaseFile &setup, CaseProblem &problem,
                    const std::vector<PairAtStart> &pairs);

} // namespace synovia
