#include "synovia/mesh/element_nodes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace synovia
{

using namespace mfem;

namespace
{

// The longest edge of the box around the rows.
real_t Extent(const DenseMatrix &positions)
{
   real_t extent = 0.0;
   for (int d = 0; d < positions.Width(); d++)
   {
      const real_t *const column = positions.GetColumn(d);
      const auto range =
         std::minmax_element(column, column + positions.Height());
      extent = std::max(extent, *range.second - *range.first);
   }
   return extent;
}

} // namespace

int SetElementNodes(Mesh &mesh, int order,
                    const std::function<void(int, DenseMatrix &)> &positions_of,
                    bool discontinuous)
{
   mesh.SetCurvature(order, discontinuous, 3, Ordering::byVDIM);
   GridFunction &nodes = *mesh.GetNodes();
   const FiniteElementSpace &space = *nodes.FESpace();
   std::vector<char> known(space.GetNDofs(), 0);
   // Files hold six digits or more.
   const real_t tolerance =
      std::max(1e-5, 100.0 * std::numeric_limits<real_t>::epsilon());
   int misfit = -1;
   Array<int> dofs;
   DenseMatrix positions;
   for (int i = 0; i < mesh.GetNE(); i++)
   {
      space.GetElementDofs(i, dofs);
      positions_of(i, positions);
      MFEM_VERIFY(positions.Height() == dofs.Size() && positions.Width() == 3,
                  "element " << i << " has " << dofs.Size() << " nodes");
      const real_t allowed = tolerance * Extent(positions);
      for (int j = 0; j < dofs.Size(); j++)
      {
         for (int d = 0; d < 3; d++)
         {
            real_t &node = nodes(space.DofToVDof(dofs[j], d));
            const bool fits =
               !known[dofs[j]] || std::abs(node - positions(j, d)) <= allowed;
            misfit = misfit < 0 && !fits ? i : misfit;
            node = positions(j, d);
         }
         known[dofs[j]] = 1;
      }
   }
   return misfit;
}

} // namespace synovia
