#pragma once

#include "synovia/materials/material_frame.hpp"
#include "synovia/materials/solid_law.hpp"

#include <map>
#include <string>
#include <vector>

namespace synovia
{

/// What a law is made from. Borrows the frame and the parts.
struct LawArguments
{
   /// By the names of the law's parameters.
   std::map<std::string, mfem::real_t> values;
   const MaterialFrame &frame;
   /// Of the undeformed material.
   mfem::real_t solid_fraction;
   /// Of a mixture; of a distribution its fibers.
   std::vector<const SolidLaw *> parts;
   /// By the names of the law's vectors.
   std::map<std::string, Point3> vectors{};

   /// The value of a parameter, which must be there.
   mfem::real_t operator[](const std::string &parameter) const
   {
      return values.at(parameter);
   }
   const Point3 &Vector(const std::string &name) const
   {
      return vectors.at(name);
   }
};

} // namespace synovia
