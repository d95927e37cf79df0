#include "synovia/fem/node_positions.hpp"

namespace synovia
{

using namespace mfem;

Vector NodePositions(ParFiniteElementSpace &space)
{
   ParGridFunction position(&space);
   VectorFunctionCoefficient identity(3, [](const Vector &x, Vector &value)
                                      { value = x; });
   position.ProjectCoefficient(identity);
   Vector true_dofs;
   position.GetTrueDofs(true_dofs);
   true_dofs.HostReadWrite();
   return true_dofs;
}

} // namespace synovia
