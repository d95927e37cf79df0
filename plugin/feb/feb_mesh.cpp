#include "synovia/feb/feb_mesh.hpp"

#include <set>

namespace synovia
{

using namespace mfem;

namespace
{
void ReadNodes(const FebInput &nodes, FebMesh &mesh)
{
   nodes.Attribute("name");
   for (const FebInput &node : nodes.All("node"))
   {
      const long long number = node.NeededNumber("id");
      const std::vector<real_t> x = node.Numbers();
      if (x.size() != 3)
      {
         node.Stop("found " + std::to_string(x.size()) +
                   " coordinates; there must be three");
         continue;
      }
      const int place = static_cast<int>(mesh.nodes.size());
      if (!mesh.places.emplace(number, place).second)
      {
         node.Stop("there are two nodes with the number " +
                   std::to_string(number));
         continue;
      }
      mesh.nodes.push_back({x[0], x[1], x[2]});
      mesh.numbers.push_back(number);
   }
}

// Places of nodes by their numbers; empty after an error.
std::vector<int> Places(const FebInput &where,
                        const std::vector<long long> &numbers,
                        const FebMesh &mesh)
{
   std::vector<int> places;
   for (const long long number : numbers)
   {
      const auto found = mesh.places.find(number);
      if (found == mesh.places.end())
      {
         where.Stop("there is no node " + std::to_string(number));
         return {};
      }
      places.push_back(found->second);
   }
   return places;
}

void ReadElements(const FebInput &elements, FebMesh &mesh)
{
   FebPart part;
   const std::string type = elements.NeededAttribute("type");
   part.name = elements.Attribute("name");
   part.material = elements.Attribute("mat");
   part.line = elements.Line();
   part.shape = FindFebShape(type);
   if (!part.shape)
   {
      elements.Stop("elements of the type \"" + type +
                    "\" are not known; there are " + FebShapeNames());
      elements.All("elem");
      return;
   }
   if (part.name.empty())
   {
      part.name = "part" + std::to_string(mesh.parts.size() + 1);
   }
   for (const FebPart &other : mesh.parts)
   {
      if (other.name == part.name)
      {
         elements.Stop("there are elements called \"" + part.name +
                       "\" already");
      }
   }
   if (part.name.find_first_of("\"\\") != std::string::npos)
   {
      elements.Stop("the name has a quote or a backslash");
   }
   for (const FebInput &cell : elements.All("elem"))
   {
      const long long number = cell.NeededNumber("id");
      const std::vector<long long> numbers = cell.Integers();
      if (static_cast<int>(numbers.size()) != part.shape->nodes)
      {
         cell.Stop("found " + std::to_string(numbers.size()) + " nodes; " +
                   part.shape->name + " has " +
                   std::to_string(part.shape->nodes));
         continue;
      }
      const std::vector<int> nodes = Places(cell, numbers, mesh);
      if (std::set<int>(nodes.begin(), nodes.end()).size() < nodes.size())
      {
         cell.Stop("a node is there twice");
         continue;
      }
      if (!nodes.empty())
      {
         part.cells.push_back({number, nodes});
      }
   }
   mesh.parts.push_back(part);
}

// As text, or in versions before 4.0 as an element for each node.
std::vector<int> NodesOf(const FebInput &set, const FebMesh &mesh)
{
   std::vector<long long> numbers = set.Integers();
   for (const FebInput &node : set.All())
   {
      numbers.push_back(node.NeededNumber("id"));
   }
   return Places(set, numbers, mesh);
}

void ReadDiscreteSet(const FebInput &set, FebMesh &mesh)
{
   std::vector<std::pair<int, int>> &ends =
      mesh.discrete_sets[set.NeededAttribute("name")];
   for (const FebInput &element : set.All("delem"))
   {
      element.Attribute("id");
      const std::vector<int> nodes = Places(element, element.Integers(), mesh);
      if (nodes.size() == 2)
      {
         ends.emplace_back(nodes[0], nodes[1]);
      }
      else
      {
         element.Stop("an element of a DiscreteSet has two nodes");
      }
   }
}

void ReadSurface(const FebInput &surface, FebMesh &mesh)
{
   std::vector<std::vector<int>> &facets =
      mesh.surfaces[surface.NeededAttribute("name")];
   for (const FebInput &facet : surface.All())
   {
      facet.Attribute("id");
      const size_t corners = FacetCorners(facet.Name());
      const std::vector<long long> numbers = facet.Integers();
      if (corners == 0 || numbers.size() < corners)
      {
         facet.Stop(corners == 0 ? "facets of this type are not known"
                                 : "found " + std::to_string(numbers.size()) +
                                      " nodes; there must be more");
         continue;
      }
      std::vector<int> nodes = Places(facet, numbers, mesh);
      if (nodes.size() >= corners)
      {
         nodes.resize(corners);
         facets.push_back(nodes);
      }
   }
}

// Names in elements, or before version 3.0 in attributes.
std::string Side(const FebInput &pair, const std::string &now,
                 const std::string &former)
{
   for (const std::string &name : {now, former})
   {
      if (const std::optional<FebInput> side = pair.Find(name))
      {
         return side->Text().empty() ? side->NeededAttribute("surface")
                                     : side->Text();
      }
   }
   pair.Stop("the " + now + " surface is missing");
   return "";
}
} // namespace

FebMesh ReadFebMesh(const FebInput &section)
{
   FebMesh mesh;
   for (const FebInput &nodes : section.All("Nodes"))
   {
      ReadNodes(nodes, mesh);
   }
   for (const FebInput &elements : section.All("Elements"))
   {
      ReadElements(elements, mesh);
   }
   for (const FebInput &set : section.All("NodeSet"))
   {
      mesh.node_sets[set.NeededAttribute("name")] = NodesOf(set, mesh);
   }
   for (const FebInput &surface : section.All("Surface"))
   {
      ReadSurface(surface, mesh);
   }
   for (const FebInput &set : section.All("DiscreteSet"))
   {
      ReadDiscreteSet(set, mesh);
   }
   for (const FebInput &pair : section.All("SurfacePair"))
   {
      const std::string primary = Side(pair, "primary", "master");
      mesh.surface_pairs[pair.NeededAttribute("name")] = {
         primary, Side(pair, "secondary", "slave")};
   }
   section.Ignore("ElementSet", "it is read where it is named");
   for (const char *name : {"Edge", "PartList"})
   {
      section.Ignore(name, "nothing that is read refers to it");
   }
   if (mesh.nodes.empty() || mesh.parts.empty())
   {
      section.Stop("there is no mesh here: Nodes or Elements are missing");
   }
   return mesh;
}

void ReadMeshDomains(const FebInput &section, FebMesh &mesh)
{
   for (const FebInput &domain : section.All())
   {
      const std::string name = domain.NeededAttribute("name");
      const std::string material = domain.NeededAttribute("mat");
      if (domain.Name() != "SolidDomain" && domain.Name() != "ShellDomain")
      {
         domain.Stop("domains of this kind are not known; there are "
                     "SolidDomain and ShellDomain");
         continue;
      }
      const std::string type = domain.Attribute("type");
      if (domain.Name() == "SolidDomain" && !type.empty() &&
          type != "elastic-solid" && type != "biphasic-solid" &&
          type != "rigid-solid")
      {
         domain.Stop("elements of the formulation \"" + type +
                     "\" are not known");
      }
      domain.Ignore("shell_thickness", "only rigid shells are read");
      bool found = false;
      for (FebPart &part : mesh.parts)
      {
         if (part.name == name)
         {
            part.material = material;
            found = true;
         }
      }
      if (!found)
      {
         domain.Stop("there are no elements called \"" + name + "\"");
      }
   }
}

} // namespace synovia
