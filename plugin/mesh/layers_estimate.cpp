#include "synovia/mesh/layers_estimate.hpp"
#include "synovia/general/error.hpp"
#include "synovia/general/resource_use.hpp"
#include "synovia/general/text.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace synovia
{

using namespace mfem;

namespace
{
/// Of elements of second order with their vertices, faces and edges.
constexpr real_t bytes_an_element = 1000.0;
/// Value and column.
constexpr real_t bytes_an_entry = 12.0;

real_t NodesOfElement(Element::Type type, real_t k)
{
   return type == Element::HEXAHEDRON ? std::pow(k + 1.0, 3)
                                      : (k + 1.0) * (k + 2.0) * (k + 3.0) / 6.0;
}
} // namespace

LayersEstimate EstimateLayers(const LayersOptions &options, int order)
{
   const real_t pressure_order = std::max(1, order - 1);
   const real_t split = std::pow(2.0, options.refine);
   const bool hexahedra = options.type == Element::HEXAHEDRON;
   const real_t in_cell = hexahedra ? 1.0 : 6.0;
   LayersEstimate estimate;
   real_t elements = 0.0;
   for (const real_t cells : {options.lower_cells, options.upper_cells})
   {
      const real_t through = std::max<real_t>(
         1.0, std::round(cells * options.thickness / options.width));
      const auto nodes = [&](real_t k) {
         return std::pow(k * split * cells + 1.0, 2) *
                (k * split * through + 1.0);
      };
      const real_t here = in_cell * cells * cells * through;
      estimate.unsplit_elements += here;
      elements += here * std::pow(split, 3);
      estimate.unknowns += 3.0 * nodes(order) + nodes(pressure_order);
   }
   const real_t dofs = 3.0 * NodesOfElement(options.type, order) +
                       NodesOfElement(options.type, pressure_order);
   const real_t held_whole = hexahedra ? 0.0 : estimate.unsplit_elements;
   // Entries of neighbors' matrices that fall together are about half.
   estimate.gigabytes = 1e-9 * (bytes_an_element * (held_whole + elements) +
                                bytes_an_entry * 0.5 * dofs * dofs * elements);
   return estimate;
}

void VerifySize(const LayersEstimate &estimate, MPI_Comm comm)
{
   const auto verify = [&](real_t value, real_t most, const std::string &what)
   {
      if (!(value <= most))
      {
         throw Error("the problem is too large: " + ToText(estimate.unknowns) +
                     " unknowns, at least " + ToText(estimate.gigabytes) +
                     " GB of memory; " + what + " " + ToText(most));
      }
   };
   constexpr real_t most_elements = std::numeric_limits<int>::max();
   verify(estimate.unsplit_elements, most_elements,
          "elements before they are split can be no more than");
   verify(estimate.unknowns,
          static_cast<real_t>(std::numeric_limits<HYPRE_BigInt>::max()),
          "this build of hypre numbers no more than");
   verify(estimate.gigabytes, 1e-9 * PhysicalMemory(comm),
          "the machine has, in GB,");
}

} // namespace synovia
