#pragma once

#include "synovia/cases/case_problem.hpp"

#include <string>
#include <vector>

namespace synovia
{

/// What applies on the boundaries of a case, by their attributes.
class SurfaceConditions
{
public:
   SurfaceConditions(const CaseFile &setup, const NamedMesh &mesh);

   /// Whether nothing in the case names the attribute: no traction is on it,
   /// and no fluid leaves.
   bool None(int attribute) const { return by_attribute[attribute].none; }

   /// Whether only the displacement along that axis is held, at zero.
   bool IsSymmetry(int attribute, int axis) const;

   /// In words, the solid's conditions before the fluid's.
   std::string Text(int attribute) const;

private:
   struct Conditions
   {
      bool none = true;
      bool displaced[3] = {false, false, false};
      bool moving = false;
      bool loaded = false;
      bool springs = false;
      bool rigid = false;
      bool force = false;
      bool contact = false;
      bool tied = false;
      bool pressure = false;
      bool sealed = false;
      bool flux = false;
   };
   void Add(const BoundaryCase &boundary, Conditions &conditions) const;

   std::vector<Conditions> by_attribute;
};

} // namespace synovia
