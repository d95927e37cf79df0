#include "synovia/cases/conditions_in_force.hpp"
#include "synovia/cases/key_names.hpp"

#include <algorithm>

namespace synovia
{

namespace
{
std::string NameOf(const BoundaryCase &boundary)
{
   return boundary.name;
}

std::string NameOf(const RigidBodyCase &body)
{
   return body.name;
}

std::string NameOf(const Ligament &ligament)
{
   return ligament.name;
}

std::string NameOf(const ContactCase &contact)
{
   return contact.Name();
}

std::string NameOf(const TieCase &tie)
{
   return tie.Name();
}

template <typename Items>
auto FindIn(Items &items, const std::string &name)
{
   return std::find_if(items.begin(), items.end(),
                       [&](const auto &item)
                       { return !name.empty() && NameOf(item.entry) == name; });
}
} // namespace

template <typename Entry>
ConditionsInForce<Entry>::ConditionsInForce(const std::string &list_,
                                            const std::vector<Entry> &entries)
   : list(list_)
{
   for (size_t i = 0; i < entries.size(); i++)
   {
      items.push_back({entries[i], EntryPath(list, i)});
   }
}

template <typename Entry>
const Entry *ConditionsInForce<Entry>::Find(const std::string &name) const
{
   const auto found = FindIn(items, name);
   return found == items.end() ? nullptr : &found->entry;
}

template <typename Entry>
std::vector<std::string> ConditionsInForce<Entry>::Names() const
{
   std::vector<std::string> names;
   for (const Item &item : items)
   {
      if (!NameOf(item.entry).empty())
      {
         names.push_back(NameOf(item.entry));
      }
   }
   return names;
}

template <typename Entry>
void ConditionsInForce<Entry>::Set(const Entry &entry, const std::string &path)
{
   const auto found = FindIn(items, NameOf(entry));
   if (found == items.end())
   {
      items.push_back({entry, path});
   }
   else
   {
      *found = {entry, path};
   }
}

template <typename Entry>
void ConditionsInForce<Entry>::Remove(const std::string &name)
{
   const auto found = FindIn(items, name);
   if (found != items.end())
   {
      items.erase(found);
   }
}

template <typename Entry>
std::vector<Entry> ConditionsInForce<Entry>::Entries() const
{
   std::vector<Entry> entries;
   for (const Item &item : items)
   {
      entries.push_back(item.entry);
   }
   return entries;
}

template <typename Entry>
void ConditionsInForce<Entry>::AddPlaces(const CasePlaces &written,
                                         CasePlaces &places) const
{
   for (size_t i = 0; i < items.size(); i++)
   {
      const std::string &from = items[i].path;
      const std::string to = EntryPath(list, i);
      for (auto place = written.lower_bound(from); place != written.end();
           ++place)
      {
         if (place->first.compare(0, from.size(), from) != 0)
         {
            break;
         }
         const std::string rest = place->first.substr(from.size());
         if (rest.empty() || rest[0] == '.')
         {
            places[to + rest] = place->second;
         }
      }
   }
}

template class ConditionsInForce<BoundaryCase>;
template class ConditionsInForce<RigidBodyCase>;
template class ConditionsInForce<Ligament>;
template class ConditionsInForce<ContactCase>;
template class ConditionsInForce<TieCase>;

} // namespace synovia
