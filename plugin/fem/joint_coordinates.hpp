#pragma once

#include "synovia/fem/joint.hpp"
#include "synovia/fem/rigid_body.hpp"
#include "synovia/general/second_order.hpp"
#include "synovia/materials/deformation.hpp"

namespace synovia
{

/// Where a bone of a joint is: that of space has a pose of zeros.
struct BonePose
{
   RigidPose pose{};
   /// Of the rigid body, as meshed (length).
   Point3 reference{};
};

/// The coordinates of a joint, in the order of JointCoordinateNames(), with
/// their derivatives by the pose of the proximal bone and that of the distal
/// one, 6 numbers each.
///
/// I, J, K are the axes of the proximal bone (right, anterior, proximal), i, j,
/// k those of the distal one, e = k x I / |k x I| is the floating axis and H
/// goes from the proximal origin to the distal one. For a right joint
///
///     flexion             atan2(-e.K, e.J)        about I, fixed to the
///                                                 proximal bone
///     abduction           -asin(I.k)              about e
///     internal rotation   atan2(e.i, e.j)         about k, fixed to the distal
///                                                 bone
///     lateral             H.I
///     anterior            H.e
///     distraction         -H.k
///
/// and abduction, internal rotation and lateral have the other sign for a left
/// one. At 90 degrees of abduction the axes I and k are parallel, and neither
/// flexion nor internal rotation are defined.
std::array<SecondOrder<12>, 6> JointCoordinates(const Joint &joint,
                                                const BonePose &proximal,
                                                const BonePose &distal,
                                                Deformation deformation);

} // namespace synovia
