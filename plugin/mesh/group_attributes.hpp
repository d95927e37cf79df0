#pragma once

#include "synovia/mesh/named_mesh.hpp"

#include <map>
#include <string>
#include <vector>

namespace synovia
{

/// Attributes for gmsh's physical groups of one dimension.
///
/// An attribute is the tag of the group, but elements in several groups get,
/// for each combination of groups, an attribute of their own.
class GroupAttributes
{
public:
   /// Borrows the names of all groups, by their tags.
   explicit GroupAttributes(const std::map<int, std::string> &names);

   /// The attribute of elements in just these groups: one at least, ascending.
   int Attribute(const std::vector<int> &groups);

   /// An attribute that no group has: the lowest above all others.
   int Next() const { return next; }

   /// The attributes in use under the names of their groups. A tag that is not
   /// the attribute of its group is a name for it too.
   NameTable Names() const;

private:
   const std::map<int, std::string> &names;
   std::map<std::vector<int>, int> used;
   int next;
};

} // namespace synovia
