#include "synovia/physics/rigid_resultants.hpp"
#include "synovia/fem/joint_coordinates.hpp"

#include <algorithm>
#include <cmath>
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

bool Holds(const Ligament &ligament, const std::string &body,
           const Point3 &direction)
{
   // Beside 1, that of one along the direction.
   constexpr real_t across = 1e-3;
   if (ligament.from.body != body && ligament.to.body != body)
   {
      return false;
   }
   const Point3 along = Sum(ligament.to.point, -1.0, ligament.from.point);
   const real_t lengthens = (ligament.to.body == body ? 1.0 : -1.0) *
                            Dot(along, direction) / Length(along);
   return lengthens > across ||
          (ligament.options.compression && lengthens < -across);
}

bool Holds(const Joint &joint, const std::string &body, const Point3 &direction,
           Deformation deformation)
{
   constexpr real_t across = 1e-3;
   const auto coordinates = JointCoordinates(joint, {}, {}, deformation);
   bool holds = false;
   for (int side = 0; side < 2; side++)
   {
      const bool moves =
         (side == 0 ? joint.proximal : joint.distal).body == body;
      for (int c = 3; moves && c < 6; c++)
      {
         const auto &slope = coordinates[c].first;
         const Point3 along{
            {slope[6 * side], slope[6 * side + 1], slope[6 * side + 2]}};
         holds = holds || (joint.prescribed[c] &&
                           std::abs(Dot(along, direction)) > across);
      }
   }
   return holds;
}
} // namespace

std::vector<DrivenSurface>
FindRigidResultants(const BoundaryConditions &conditions)
{
   std::vector<DrivenSurface> resultants;
   for (const RigidBody &body : conditions.RigidBodies())
   {
      const std::vector<real_t> times = TimesOf(body.options);
      const std::optional<Point3> direction =
         FirstDirection(body.options, times);
      if (!direction || Holds(conditions, body, *direction))
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

bool Holds(const BoundaryConditions &conditions, const RigidBody &body,
           const Point3 &direction)
{
   const std::vector<Ligament> &ligaments = conditions.Ligaments();
   bool holds = std::any_of(ligaments.begin(), ligaments.end(),
                            [&](const Ligament &ligament)
                            { return Holds(ligament, body.name, direction); });
   for (const Joint &joint : conditions.Joints())
   {
      holds = holds ||
              Holds(joint, body.name, direction, conditions.GetDeformation());
   }
   for (int d = 0; d < 3; d++)
   {
      holds = holds ||
              (direction[d] != 0.0 &&
               (!body.options.IsFree(d) || body.options.stiffness[d] > 0.0));
   }
   return holds;
}

} // namespace synovia
