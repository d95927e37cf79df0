#pragma once

#include "synovia/general/load_curve.hpp"
#include "synovia/general/point3.hpp"

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace synovia
{

/// One of the two bones of a joint, with axes that are fixed to it.
struct JointSide
{
   /// A rigid body; empty: space.
   std::string body{};
   /// As meshed (length).
   Point3 origin{{0.0, 0.0, 0.0}};
   /// Axis of flexion, mediolateral, towards the right of the subject; of any
   /// length.
   Point3 flexion_axis{{1.0, 0.0, 0.0}};
   /// Towards the proximal end of the bone. Of a proximal side, its part across
   /// the axis of flexion counts; of a distal side, the part of the other axis
   /// that is across this one.
   Point3 long_axis{{0.0, 0.0, 1.0}};
};

/// Of the body.
enum class JointOf
{
   right,
   left
};

/// How the distal bone of a joint is placed beside the proximal one, after
/// Grood & Suntay (J Biomech Eng 105(2):136-144, 1983).
struct Joint
{
   /// In messages and output.
   std::string name{};
   JointSide proximal{};
   JointSide distal{};
   JointOf of = JointOf::right;
   /// By coordinate (rad, then length); none: it is free.
   std::array<std::optional<LoadCurve>, 6> prescribed{};
};

/// Flexion, abduction, internal rotation; lateral, anterior, distraction: the
/// names of the six coordinates, angles first.
const std::array<std::string, 6> &JointCoordinateNames();

/// What makes no sense in it where there are these rigid bodies; empty if there
/// is nothing.
std::string Contradiction(const Joint &joint,
                          const std::vector<std::string> &bodies);

} // namespace synovia
