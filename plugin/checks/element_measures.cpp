#include "synovia/checks/element_measures.hpp"
#include "synovia/general/reduce_lists.hpp"
#include "synovia/general/text_table.hpp"
#include "synovia/mesh/element_measure.hpp"
#include "synovia/mesh/mesh_quality.hpp"

#include <algorithm>

namespace synovia
{

using namespace mfem;

namespace
{
// Elements below this are flat enough to spoil stresses and iterations.
constexpr real_t poor_quality = 0.05;

/// Sums and minima by attribute.
struct Totals
{
   explicit Totals(int attributes)
      : elements(attributes + 1, 0.0), volume(elements),
        quality(attributes + 1, std::numeric_limits<real_t>::infinity())
   {
   }
   void Reduce(MPI_Comm comm)
   {
      SumOverRanks(elements, comm);
      SumOverRanks(volume, comm);
      MinOverRanks(quality, comm);
   }

   std::vector<real_t> elements;
   std::vector<real_t> volume;
   std::vector<real_t> quality;
};

void AddElements(ParMesh &mesh, Totals &totals)
{
   const Vector jacobians = ScaledJacobians(mesh);
   for (int i = 0; i < mesh.GetNE(); i++)
   {
      const int region = mesh.GetAttribute(i);
      totals.elements[region] += 1.0;
      totals.volume[region] += Measure(*mesh.GetElementTransformation(i));
      totals.quality[region] = std::min(totals.quality[region], jacobians[i]);
   }
}
} // namespace

std::vector<ElementMeasures> MeasureElements(NamedMesh &named)
{
   ParMesh &mesh = named.Get();
   Totals totals(mesh.attributes.Max());
   AddElements(mesh, totals);
   totals.Reduce(named.GetComm());
   std::vector<ElementMeasures> regions;
   for (const int attribute : mesh.attributes)
   {
      regions.push_back({static_cast<long long>(totals.elements[attribute]),
                         totals.volume[attribute], totals.quality[attribute]});
   }
   return regions;
}

std::vector<std::string>
FindQualityWarnings(const NamedMesh &mesh,
                    const std::vector<ElementMeasures> &regions)
{
   std::vector<std::string> warnings;
   for (size_t i = 0; i < regions.size(); i++)
   {
      if (regions[i].quality < poor_quality)
      {
         const int attribute = mesh.Get().attributes[static_cast<int>(i)];
         warnings.push_back(
            "the worst element of \"" + NameOf(mesh.Regions(), attribute) +
            "\" has a scaled Jacobian of " + Quantity(regions[i].quality) +
            " (1 is perfect, 0 is flat)");
      }
   }
   return warnings;
}

} // namespace synovia
