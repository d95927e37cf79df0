#pragma once

#include "synovia/cases/case_value.hpp"

#include <map>
#include <string>
#include <vector>

namespace synovia
{

/// Where each key of a case was written, by path (such as material.0.solid.E).
using CasePlaces = std::map<std::string, CasePlace>;

/// "file:line:column: path", with the place of the path or of the nearest part
/// of it that has one; the path alone if none has.
std::string WhereIs(const CasePlaces &places, const std::string &path);

/// What there is to say against a case, for a user to mend all of it at once.
class CaseReading
{
public:
   CaseReading() = default;
   /// Takes the places that an earlier reading found.
   explicit CaseReading(CasePlaces places_) : places(std::move(places_)) {}

   void SetPlace(const std::string &path, const CasePlace &place);
   const CasePlaces &Places() const { return places; }

   void AddError(const std::string &path, const std::string &problem);
   /// For a value of the wrong type.
   void Expect(const std::string &path, const std::string &expected,
               const CaseValue &found);
   /// Whether there is a complaint about this path.
   bool HasError(const std::string &path) const;
   size_t Count() const { return complaints.size(); }

   /// Throws Error with the complaints in the order of the file, ten of them at
   /// most, a line each, if there are any.
   void ThrowIfAny() const;

private:
   struct CaseError
   {
      CasePlace place;
      std::string path;
      std::string text;
   };

   CasePlaces places;
   std::vector<CaseError> complaints;
};

} // namespace synovia
