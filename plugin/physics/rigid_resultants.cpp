#include "synovia/physics/rigid_resultants.hpp"

#include <algorithm>
#include <optional>

namespace synovia
{

using namespace mfem;

namespace
{
Point3 ForceAt(const RigidBodyOptions &body, real_t t)
{
   return {body.load[0](t), body.load[1](t), body.load[2](t)};
}

std::vector<real_t> TimesOf(const RigidBodyOptions &body)
{
   std::vector<real_t> times;
   for (int d = 0; d < 3; d++)
   {
      const std::vector<real_t> &corners = body.load[d].Corners();
      times.insert(times.end(), corners.begin(), corners.end());
   }
   std::sort(times.begin(), times.end());
   times.erase(std::unique(times.begin(), times.end()), times.end());
   return times;
}

// Unit vector, if there is a force at any time.
std::optional<Point3> FirstDirection(const RigidBodyOptions &body,
                                     const std::vector<real_t> &times)
{
   for (const real_t t : times)
   {
      const Point3 force = ForceAt(body, t);
      const real_t length = Length(force);
      if (length > 0.0)
      {
         return Sum({{0.0, 0.0, 0.0}}, 1.0 / length, force);
      }
   }
   return std::nullopt;
}
} // namespace

std::vector<DrivenSurface>
FindRigidResultants(const std::vector<RigidBody> &bodies)
{
   std::vector<DrivenSurface> resultants;
   for (const RigidBody &body : bodies)
   {
      const std::vector<real_t> times = TimesOf(body.options);
      const std::optional<Point3> direction =
         FirstDirection(body.options, times);
      if (!direction || Holds(body.options, *direction))
      {
         continue;
      }
      std::vector<real_t> values;
      for (const real_t t : times)
      {
         values.push_back(Dot(*direction, ForceAt(body.options, t)));
      }
      resultants.push_back(
         {body.name, body.boundary, *direction, LoadCurve(times, values)});
   }
   return resultants;
}

bool Holds(const RigidBodyOptions &body, const Point3 &direction)
{
   bool holds = false;
   for (int d = 0; d < 3; d++)
   {
      holds = holds || (direction[d] != 0.0 &&
                        (!body.IsFree(d) || body.stiffness[d] > 0.0));
   }
   return holds;
}

} // namespace synovia
