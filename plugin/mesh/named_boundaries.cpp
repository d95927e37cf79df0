#include "synovia/mesh/named_boundaries.hpp"

namespace synovia
{

using namespace mfem;

Array<int> NamedBoundaries(const NamedMesh &mesh,
                           const std::vector<std::string> &names)
{
   Array<int> attributes;
   for (const std::string &name : names)
   {
      attributes.Append(mesh.Boundary(name));
   }
   attributes.Sort();
   attributes.Unique();
   return attributes;
}

} // namespace synovia
