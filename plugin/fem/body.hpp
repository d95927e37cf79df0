#pragma once

#include "synovia/fem/biphasic_spaces.hpp"
#include "synovia/mesh/named_mesh.hpp"

#include <set>
#include <string>
#include <vector>

namespace synovia
{

/// Regions that share vertices or are joined, and so move together.
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

/// The same bodies with those as one that have any of the attributes of the
/// boundary in one of the lists @a joined.
std::vector<Body> JoinBodies(const std::vector<Body> &bodies,
                             const std::vector<mfem::Array<int>> &joined);

} // namespace synovia
