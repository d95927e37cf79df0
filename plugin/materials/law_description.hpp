#pragma once

#include "synovia/general/number_range.hpp"
#include "synovia/general/point3.hpp"
#include "synovia/materials/deformation.hpp"

#include <initializer_list>
#include <optional>
#include <string>
#include <vector>

namespace synovia
{

/// A parameter of a law, with its description for case files.
struct LawParameter
{
   /// The key.
   std::string name;
   std::string unit;
   /// What it is, as messages name it.
   std::string noun;
   NumberRange range;
   /// The default; the parameter is required if this is empty.
   std::optional<mfem::real_t> standard;

   /// Throws Error unless @a value is in the range.
   void Verify(mfem::real_t value) const;
};

/// Three numbers that a law takes, for the axes r, theta, z of its frame.
struct LawVector
{
   /// The key.
   std::string name;
   std::string unit;
   /// What it is, as messages name it.
   std::string noun;
   /// Of each of the three.
   NumberRange range;
   /// As in LawParameter.
   std::optional<Point3> standard;

   /// Throws Error unless the components of @a value are in the range.
   void Verify(const Point3 &value) const;
};

/// The keys of a law in a case file: its name and its parameters.
struct LawDescription
{
   /// The key model.
   std::string name;
   std::string meaning;
   /// The only deformation that it is for; any if empty.
   std::optional<Deformation> only_for;
   std::vector<LawParameter> parameters;
   /// Whether it is made of other laws.
   bool has_parts = false;
   std::vector<LawVector> vectors{};
   /// Whether it is a law of fibers, a FiberEnergy.
   bool is_fiber = false;
   /// Whether it is made of the fibers of another law.
   bool has_fibers = false;

   bool Allows(Deformation deformation) const;
   /// The parameter of that name, or null.
   const LawParameter *Find(const std::string &name) const;
   const LawVector *FindVector(const std::string &name) const;
   /// Throws Error unless each parameter's value, in order, is in its range.
   void Verify(std::initializer_list<mfem::real_t> values) const;
};

/// E and nu of small strains.
LawParameter YoungsModulus();
LawParameter PoissonsRatio();
/// value, the permeability of the undeformed body.
LawParameter ReferencePermeability();
/// One of several that add up.
LawParameter PermeabilityPart(const std::string &name);

/// Throws Error unless the volume fraction is between 0 and 1.
void VerifySolidFraction(mfem::real_t solid_fraction);

} // namespace synovia
