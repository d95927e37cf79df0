#pragma once

#include "synovia/cases/case_file.hpp"

#include <string>
#include <vector>

namespace synovia
{

/// What is prescribed at a time: the entries of a list of the case that hold,
/// with the paths at which they are written.
template <typename Entry>
class ConditionsInForce
{
public:
   /// All entries of the case.
   ConditionsInForce(const std::string &list_,
                     const std::vector<Entry> &entries);

   /// The entry of this name, or null.
   const Entry *Find(const std::string &name) const;
   std::vector<std::string> Names() const;
   /// Adds an entry, in place of the one of its name if there is one.
   void Set(const Entry &entry, const std::string &path);
   /// Removes the entry of this name, if there is one.
   void Remove(const std::string &name);

   std::vector<Entry> Entries() const;
   /// Adds the places of the entries, numbered as a list of their own.
   void AddPlaces(const CasePlaces &written, CasePlaces &places) const;

private:
   struct Item
   {
      Entry entry;
      std::string path;
   };

   std::string list;
   std::vector<Item> items;
};

extern template class ConditionsInForce<BoundaryCase>;
extern template class ConditionsInForce<RigidBodyCase>;
extern template class ConditionsInForce<Ligament>;
extern template class ConditionsInForce<ContactCase>;

} // namespace synovia
