#include "synovia/mesh/group_attributes.hpp"

#include <algorithm>

namespace synovia
{

GroupAttributes::GroupAttributes(const std::map<int, std::string> &names_)
   : names(names_), next(names.empty() ? 1 : names.rbegin()->first + 1)
{
}

int GroupAttributes::Attribute(const std::vector<int> &groups)
{
   const auto known = used.find(groups);
   if (known != used.end())
   {
      return known->second;
   }
   const int attribute = groups.size() == 1 ? groups[0] : next++;
   used[groups] = attribute;
   return attribute;
}

NameTable GroupAttributes::Names() const
{
   NameTable table;
   for (const auto &group : names)
   {
      const int tag = group.first;
      std::vector<int> attributes;
      for (const auto &entry : used)
      {
         if (std::binary_search(entry.first.begin(), entry.first.end(), tag))
         {
            attributes.push_back(entry.second);
         }
      }
      const std::string number = std::to_string(tag);
      std::vector<int> &list = table[group.second];
      list.insert(list.end(), attributes.begin(), attributes.end());
      if (attributes != std::vector<int>(1, tag))
      {
         table[number] = attributes;
      }
   }
   for (auto &entry : table)
   {
      std::sort(entry.second.begin(), entry.second.end());
   }
   return table;
}

} // namespace synovia
