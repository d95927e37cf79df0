#include "synovia/materials/fiber_direction.hpp"

namespace synovia
{

using namespace mfem;

Vector3<> FiberDirection(const MaterialPoint &point, const MaterialFrame &frame)
{
   // In memory of this call: it is made at each point of each evaluation.
   real_t coordinates[3];
   real_t columns[9];
   Vector position(coordinates, 3);
   DenseMatrix axes(columns, 3, 3);
   point.trans.Transform(point.ip, position);
   frame.GetAxes(position, axes);
   return {axes(0, 1), axes(1, 1), axes(2, 1)};
}

} // namespace synovia
