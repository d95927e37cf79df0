#include "synovia/fem/joint.hpp"

#include <algorithm>

namespace synovia
{

using namespace mfem;

const std::array<std::string, 6> &JointCoordinateNames()
{
   static const std::array<std::string, 6> names{
      {"flexion", "abduction", "internal_rotation", "lateral", "anterior",
       "distraction"}};
   return names;
}

std::string Contradiction(const Joint &joint,
                          const std::vector<std::string> &bodies)
{
   // Sine of the least angle between axes.
   constexpr real_t apart = 0.1;
   for (const JointSide *side : {&joint.proximal, &joint.distal})
   {
      const std::string which =
         side == &joint.proximal ? "the proximal side" : "the distal side";
      if (!side->body.empty() &&
          std::find(bodies.begin(), bodies.end(), side->body) == bodies.end())
      {
         return which + ": there is no rigid body \"" + side->body + "\"";
      }
      const real_t lengths =
         Length(side->flexion_axis) * Length(side->long_axis);
      if (!(Length(Cross(side->flexion_axis, side->long_axis)) >
            apart * lengths))
      {
         return which + ": its flexion_axis and long_axis must be different "
                        "directions, about at right angles";
      }
   }
   if (joint.proximal.body == joint.distal.body)
   {
      return joint.proximal.body.empty()
                ? "both sides are fixed in space; name a rigid body"
                : "both sides are the rigid body \"" + joint.proximal.body +
                     "\"; a joint is between two";
   }
   return "";
}

} // namespace synovia
