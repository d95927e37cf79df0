#pragma once

#include "synovia/cases/case_value.hpp"
#include "synovia/general/error.hpp"

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

/// The errors of a case, collected so that users can correct all at once.
class CaseReading
{
public:
   CaseReading() = default;
   /// Takes the places that an earlier reading found.
   explicit CaseReading(CasePlaces places_) : places(std::move(places_)) {}

   void SetPlace(const std::string &path, const CasePlace &place);
   const CasePlaces &Places() const { return places; }

   void AddError(const std::string &path, const std::string &problem);
   /// Adds the error unless it is @a good, or the path has an error already.
   void Require(bool good, const std::string &path, const std::string &problem);
   /// Adds the errors of another reading, with @a context before each.
   void Append(const CaseReading &other, const std::string &context);
   /// Whether there is an error at this path.
   bool HasError(const std::string &path) const;
   size_t Count() const { return errors.size(); }
   /// Calls @a what; an Error that it throws becomes one of this path.
   template <typename Function>
   void Catch(const std::string &path, Function what)
   {
      try
      {
         what();
      }
      catch (const Error &error)
      {
         AddError(path, error.what());
      }
   }

   /// Throws Error if there are any, with the first ten in the order of the
   /// file, a line each.
   void ThrowIfAny() const;

private:
   struct CaseError
   {
      CasePlace place;
      std::string path;
      std::string problem;
   };

   CasePlaces places;
   std::vector<CaseError> errors;
};

/// A value of a case that is being read: what was written, under which path,
/// and the reading that it belongs to.
class CaseInput
{
public:
   /// Borrows @a value and @a reading.
   CaseInput(const CaseValue &value, const std::string &path,
             CaseReading &reading);

   const CaseValue &Value() const { return value; }
   const CaseValue *operator->() const { return &value; }
   const std::string &Path() const { return path; }
   CaseReading &Reading() const { return reading; }
   bool Is(CaseValue::Type type) const { return value.type == type; }

   /// The entry of a list, and what is under a key of a table; their paths get
   /// their places.
   CaseInput Item(size_t i) const;
   CaseInput Member(const std::string &key, const CaseValue &member) const;

   void AddError(const std::string &problem) const;
   /// For a value of the wrong type.
   void Expect(const std::string &expected) const;
   bool HasError() const { return reading.HasError(path); }

private:
   const CaseValue &value;
   std::string path;
   CaseReading &reading;
};

} // namespace synovia
