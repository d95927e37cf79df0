#include "synovia/materials/fiber_direction.hpp"
#include "synovia/general/error.hpp"

namespace synovia
{

using namespace mfem;

namespace
{
const char *const direction_key = "direction";
constexpr Point3 along_theta{{0.0, 1.0, 0.0}};
} // namespace

FiberDirection::FiberDirection(const MaterialFrame &frame_)
   : FiberDirection(frame_, along_theta)
{
}

FiberDirection::FiberDirection(const MaterialFrame &frame_,
                               const Point3 &components_)
   : frame(frame_)
{
   const real_t length = Length(components_);
   if (!(length > 0.0) || !std::isfinite(length))
   {
      throw Error("the direction of the fibers is zero; give a vector in the "
                  "axes r, theta, z of the frame");
   }
   for (int d = 0; d < 3; d++)
   {
      components[d] = components_[d] / length;
   }
}

FiberDirection::FiberDirection(const LawArguments &from)
   : FiberDirection(from.frame, from.Vector(direction_key))
{
}

LawDescription DescribeFibers(const std::string &name,
                              const std::string &meaning,
                              const std::vector<LawParameter> &parameters)
{
   LawDescription fibers{name, meaning, Deformation::finite, parameters};
   fibers.vectors = {{direction_key,
                      "",
                      "the direction of the fibers in the axes r, theta, z of "
                      "the frame",
                      {},
                      along_theta}};
   fibers.is_fiber = true;
   return fibers;
}

} // namespace synovia
