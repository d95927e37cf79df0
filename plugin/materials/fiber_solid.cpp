#include "synovia/materials/fiber_solid.hpp"

namespace synovia
{

using namespace mfem;

Vector3<> FiberDirection(const MaterialPoint &point, const MaterialFrame &frame)
{
   Vector position(3);
   DenseMatrix axes;
   point.trans.Transform(point.ip, position);
   frame.GetAxes(position, axes);
   return {axes(0, 1), axes(1, 1), axes(2, 1)};
}

} // namespace synovia
