#pragma once

#include "mesh/gmsh_session.hpp"

#include <map>
#include <string>
#include <vector>

namespace synovia
{

/// One of gmsh's element types.
struct GmshElementType
{
   std::string name;
   int dimension = -1;
   int order = 0;
   int nodes = 0;
   int corners = 0;
   /// Reference coordinates of the nodes: u, v, w of each, the corners first.
   std::vector<double> reference;
};

/// The element types of gmsh's library.
class GmshElementTypes
{
public:
   /// The properties of a type, by its number in a file; with 0 nodes if gmsh
   /// does not have it or the type has no fixed number of nodes.
   const GmshElementType &Get(int number);

   /// Values of the Lagrange functions of a type, point after point, at
   /// reference points given as u, v, w each. Empty if gmsh does not have them.
   std::vector<double> Basis(int number,
                             const std::vector<double> &points) const;

private:
   GmshSession session;
   std::map<int, GmshElementType> known;
};

} // namespace synovia
