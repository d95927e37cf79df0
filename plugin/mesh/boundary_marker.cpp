#include "synovia/mesh/boundary_marker.hpp"
#include "synovia/general/error.hpp"

#include <string>

namespace synovia
{

using namespace mfem;

namespace
{
std::string List(const Array<int> &attributes)
{
   std::string list;
   for (const int attribute : attributes)
   {
      list += (list.empty() ? "" : ", ") + std::to_string(attribute);
   }
   return list.empty() ? "none" : list;
}
} // namespace

Array<int> BoundaryMarker(const ParMesh &mesh, const Array<int> &attributes)
{
   // The same list on all ranks, whatever faces they have.
   const Array<int> &known = mesh.bdr_attributes;
   Array<int> marker(known.Size() > 0 ? known.Max() : 0);
   marker = 0;
   for (const int attribute : attributes)
   {
      if (known.Find(attribute) < 0)
      {
         throw Error("no boundary has the attribute " +
                     std::to_string(attribute) + "; there are: " + List(known));
      }
      marker[attribute - 1] = 1;
   }
   return marker;
}

} // namespace synovia
