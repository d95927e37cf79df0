#pragma once

#include "synovia/fem/biphasic_spaces.hpp"
#include "synovia/mesh/named_mesh.hpp"

#include <set>
#include <string>
#include <vector>

namespace synovia
{

/// Regions that share vertices, and so move together.
struct Body
{
   /// The names of its regions.
   std::string name;
   std::set<int> regions;
   /// Attributes of the boundary that are on it.
   std::set<int> boundary;

   bool Touches(const mfem::Array<int> &attributes) const;
};

/// The bodies of a mesh, by their first attribute. Collective.
std::vector<Body> FindBodies(const NamedMesh &mesh, BiphasicSpaces &spaces);

} // namespace synovia
