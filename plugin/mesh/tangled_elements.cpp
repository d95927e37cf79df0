#include "synovia/mesh/tangled_elements.hpp"
#include "synovia/general/error.hpp"
#include "synovia/general/text.hpp"
#include "synovia/mesh/jacobian_samples.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <numeric>

namespace synovia
{

using namespace mfem;

namespace
{

bool Tangled(const DenseMatrix &nodes, const JacobianSamples &samples)
{
   DenseMatrix jacobian;
   for (int i = 0; i < samples.Size(); i++)
   {
      samples.Evaluate(nodes, i, jacobian);
      // Rounding leaves a flat element a determinant of either sign.
      const real_t size = jacobian.FNorm();
      const real_t flat =
         100.0 * std::numeric_limits<real_t>::epsilon() * size * size * size;
      if (!(jacobian.Det() > flat))
      {
         return true;
      }
   }
   return false;
}

std::string Describe(long long count, Mesh &mesh, int element, long long number,
                     const NameTable &regions)
{
   IsoparametricTransformation map;
   mesh.GetElementTransformation(element, &map);
   Vector center(3);
   map.Transform(Geometries.GetCenter(mesh.GetElementGeometry(element)),
                 center);
   return (count == 1 ? std::string("one element is")
                      : std::to_string(count) + " elements are") +
          " tangled (the Jacobian determinant is not positive everywhere); " +
          (count == 1 ? "it is element " : "the first is element ") +
          std::to_string(number) + " in region \"" +
          NameOf(regions, mesh.GetAttribute(element)) + "\", around (" +
          ToText(center(0)) + ", " + ToText(center(1)) + ", " +
          ToText(center(2)) + ")";
}

} // namespace

std::vector<int> TangledElements(Mesh &mesh, const std::vector<int> &elements)
{
   std::map<Geometry::Type, JacobianSamples> samples;
   IsoparametricTransformation map;
   std::vector<int> tangled;
   for (const int element : elements)
   {
      mesh.GetElementTransformation(element, &map);
      const Geometry::Type geometry = map.GetGeometryType();
      auto entry = samples.find(geometry);
      if (entry == samples.end())
      {
         const auto points = JacobianPoints(geometry, map.Order());
         entry =
            samples.emplace(geometry, JacobianSamples(*map.GetFE(), points))
               .first;
      }
      if (Tangled(map.GetPointMat(), entry->second))
      {
         tangled.push_back(element);
      }
   }
   return tangled;
}

void ThrowIfTangled(MPI_Comm comm, Mesh &mesh,
                    const std::vector<long long> &numbers,
                    const NameTable &regions)
{
   std::vector<int> elements(mesh.GetNE());
   std::iota(elements.begin(), elements.end(), 0);
   const std::vector<int> tangled = TangledElements(mesh, elements);
   const long long mine = tangled.size();
   long long count = 0;
   MPI_Allreduce(&mine, &count, 1, MPI_LONG_LONG, MPI_SUM, comm);
   if (count == 0)
   {
      return;
   }
   const auto before = [&](int a, int b) { return numbers[a] < numbers[b]; };
   const auto first = std::min_element(tangled.begin(), tangled.end(), before);
   const long long none = std::numeric_limits<long long>::max();
   const long long number = mine ? numbers[*first] : none;
   long long lowest = none;
   MPI_Allreduce(&number, &lowest, 1, MPI_LONG_LONG, MPI_MIN, comm);
   std::string message;
   if (mine && number == lowest)
   {
      message = Describe(count, mesh, *first, number, regions);
   }
   ThrowIfAny(comm, message);
}

} // namespace synovia
