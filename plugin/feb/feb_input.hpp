#pragma once

#include "synovia/feb/feb_report.hpp"

#include "mfem.hpp"

#include <optional>

namespace synovia
{

/// Of nodes and elements: others can be numbered after it.
constexpr long long largest_feb_number = 999999999999999;

/// An element that is being read: all that it is asked for counts as read, and
/// what is wrong with it is listed in the report.
///
/// Large because each kind of value and each fate of an element has a member.
class FebInput
{
public:
   /// Borrows both. @a path names it in the report; empty for the root.
   FebInput(const FebElement &element, const std::string &path,
            FebReport &report);

   const std::string &Name() const { return element.name; }
   const std::string &Path() const { return path; }
   const std::string &Text() const { return element.text; }
   int Line() const { return element.line; }

   /// Empty if there is none of the name.
   std::string Attribute(const std::string &name) const;
   bool HasAttribute(const std::string &name) const;
   /// Stops the import if it is not there.
   std::string NeededAttribute(const std::string &name) const;

   /// Likewise, and it must be an integer of at most 15 digits; 0 if it isn't.
   long long NeededNumber(const std::string &name) const;

   /// The first child of the name.
   std::optional<FebInput> Find(const std::string &name) const;
   /// The children of the name, or all.
   std::vector<FebInput> All(const std::string &name) const;
   std::vector<FebInput> All() const;

   /// What the element says. Something else than what is asked for stops the
   /// import.
   mfem::real_t Number() const { return FindNumber().value_or(0.0); }
   std::optional<mfem::real_t> FindNumber() const;
   std::vector<mfem::real_t> Numbers() const;
   std::vector<long long> Integers() const;

   /// What the child of the name says, or @a standard if there is none.
   mfem::real_t Number(const std::string &child, mfem::real_t standard) const;
   bool Flag(const std::string &child, bool standard) const;
   std::string Word(const std::string &child,
                    const std::string &standard) const;

   /// The child of the name, with all that it contains, doesn't matter.
   void Ignore(const std::string &child, const std::string &why) const;
   /// Nor does what the element contains.
   void IgnoreAll(const std::string &why) const;
   /// Nor does it matter if a flag is as expected; otherwise the import stops.
   void Expect(const std::string &child, bool value,
               const std::string &otherwise) const;

   void Approximate(const std::string &how) const;
   void Stop(const std::string &why) const;
   /// For the element with all that it contains, which goes unread.
   void StopAll(const std::string &why) const;

private:
   const std::string *FindAttribute(const std::string &name) const;
   FebInput Child(const FebElement &child) const;
   void MarkAll(const FebElement &part) const;

   const FebElement &element;
   std::string path;
   FebReport &report;
};

} // namespace synovia
