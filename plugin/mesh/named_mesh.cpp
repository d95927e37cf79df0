#include "synovia/mesh/named_mesh.hpp"
#include "synovia/general/error.hpp"
#include "synovia/general/suggestion.hpp"

#include <algorithm>
#include <numeric>

namespace synovia
{

using namespace mfem;

namespace
{

// The number that a name is, or 0. Attributes start at 1.
int AsNumber(const std::string &name)
{
   if (name.empty() || name.size() > 9 ||
       name.find_first_not_of("0123456789") != std::string::npos)
   {
      return 0;
   }
   return std::stoi(name);
}

std::string Join(const std::vector<std::string> &words)
{
   std::string text;
   for (const std::string &word : words)
   {
      text += (text.empty() ? "" : ", ") + word;
   }
   return text;
}

// Every name with attributes, then the numbers of attributes without a name.
std::vector<std::string> Known(const NameTable &names,
                               const Array<int> &present)
{
   std::vector<std::string> known;
   std::vector<int> named;
   for (const auto &entry : names)
   {
      if (!entry.second.empty())
      {
         known.push_back(entry.first);
      }
      named.insert(named.end(), entry.second.begin(), entry.second.end());
   }
   for (const int attribute : present)
   {
      if (std::find(named.begin(), named.end(), attribute) == named.end())
      {
         known.push_back(std::to_string(attribute));
      }
   }
   return known;
}

// kind: what is looked for, in words.
Array<int> Find(const std::string &kind, const std::string &name,
                const NameTable &names, const Array<int> &present)
{
   const auto entry = names.find(name);
   Array<int> attributes;
   if (entry != names.end())
   {
      for (const int attribute : entry->second)
      {
         attributes.Append(attribute);
      }
   }
   else if (present.Find(AsNumber(name)) >= 0)
   {
      attributes.Append(AsNumber(name));
   }
   if (!attributes.IsEmpty())
   {
      return attributes;
   }
   const std::vector<std::string> known = Known(names, present);
   const std::string listed =
      known.empty() ? "the mesh names none" : "there are: " + Join(known);
   if (entry != names.end())
   {
      throw Error("the " + kind + " \"" + name + "\" is empty: none of its " +
                  (kind == "boundary"
                      ? "faces is on the outside of the mesh (bodies that "
                        "touch need nodes of their own)"
                      : "elements is in the mesh") +
                  "; " + listed);
   }
   const std::string guess = Suggest(name, known);
   throw Error("no " + kind + " is named \"" + name + "\"; " + listed +
               (guess.empty() ? "" : "; did you mean \"" + guess + "\"?"));
}

void Normalize(NameTable &names)
{
   for (auto &entry : names)
   {
      std::vector<int> &list = entry.second;
      std::sort(list.begin(), list.end());
      list.erase(std::unique(list.begin(), list.end()), list.end());
   }
}

void EnterSets(const NameTable &names, AttributeSets &sets)
{
   for (const auto &entry : names)
   {
      Array<int> attributes;
      for (const int attribute : entry.second)
      {
         attributes.Append(attribute);
      }
      sets.SetAttributeSet(entry.first, attributes);
   }
}

} // namespace

NamedMesh::NamedMesh(std::unique_ptr<ParMesh> mesh_, NameTable regions_,
                     NameTable boundaries_, std::vector<int> serial_elements_)
   : mesh(std::move(mesh_)), regions(std::move(regions_)),
     boundaries(std::move(boundaries_)),
     serial_elements(std::move(serial_elements_))
{
   MFEM_VERIFY(mesh, "a named mesh needs a mesh");
   int before = 0;
   int count = mesh->GetNE();
   MPI_Scan(&count, &before, 1, MPI_INT, MPI_SUM, mesh->GetComm());
   if (serial_elements.empty())
   {
      serial_elements.resize(count);
      std::iota(serial_elements.begin(), serial_elements.end(), before - count);
   }
   MFEM_VERIFY(static_cast<int>(serial_elements.size()) == mesh->GetNE(),
               "a number is needed for each element");
   Normalize(regions);
   Normalize(boundaries);
   EnterSets(regions, mesh->attribute_sets);
   EnterSets(boundaries, mesh->bdr_attribute_sets);
}

Array<int> NamedMesh::Region(const std::string &name) const
{
   return Find("region", name, regions, mesh->attributes);
}

Array<int> NamedMesh::Boundary(const std::string &name) const
{
   return Find("boundary", name, boundaries, mesh->bdr_attributes);
}

const ElementVectors &NamedMesh::Vectors(const std::string &name) const
{
   const auto found = vectors.find(name);
   if (found == vectors.end())
   {
      std::vector<std::string> known;
      for (const auto &entry : vectors)
      {
         known.push_back(entry.first);
      }
      const std::string guess = Suggest(name, known);
      throw Error("the mesh has no vectors of elements named \"" + name +
                  "\"; " +
                  (known.empty() ? "it has none; in a gmsh file they are "
                                   "$ElementData with three components"
                                 : "there are: " + Join(known)) +
                  (guess.empty() ? "" : "; did you mean \"" + guess + "\"?"));
   }
   return found->second;
}

void NamedMesh::SetVectors(std::map<std::string, ElementVectors> vectors_)
{
   for (const auto &entry : vectors_)
   {
      MFEM_VERIFY(static_cast<int>(entry.second.vectors.size()) ==
                        mesh->GetNE() &&
                     entry.second.numbers.size() == entry.second.vectors.size(),
                  "a vector and a number are needed for each element");
   }
   vectors = std::move(vectors_);
}

std::string NameOf(const NameTable &names, int attribute)
{
   std::string text;
   for (const auto &entry : names)
   {
      const std::vector<int> &list = entry.second;
      if (std::find(list.begin(), list.end(), attribute) != list.end())
      {
         text += (text.empty() ? "" : "/") + entry.first;
      }
   }
   return text.empty() ? std::to_string(attribute) : text;
}

} // namespace synovia
