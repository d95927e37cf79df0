#include "mesh/gmsh_element_types.hpp"

#include <gmsh.h>

namespace synovia
{

const GmshElementType &GmshElementTypes::Get(int number)
{
   const auto entry = known.find(number);
   if (entry != known.end())
   {
      return entry->second;
   }
   GmshElementType &type = known[number];
   gmsh::model::mesh::getElementProperties(number, type.name, type.dimension,
                                           type.order, type.nodes,
                                           type.reference, type.corners);
   return type;
}

std::vector<double>
GmshElementTypes::Basis(int number, const std::vector<double> &points) const
{
   int components = 0;
   int orientations = 0;
   std::vector<double> values;
   gmsh::model::mesh::getBasisFunctions(number, points, "Lagrange", components,
                                        values, orientations);
   return values;
}

} // namespace synovia
