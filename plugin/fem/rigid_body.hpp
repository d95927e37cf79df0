#pragma once

#include "synovia/general/load_curve.hpp"
#include "synovia/general/point3.hpp"
#include "synovia/materials/deformation.hpp"

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace synovia
{

/// Where a rigid body is: the displacement of its reference point (length),
/// then its rotation vector (rad).
using RigidPose = std::array<mfem::real_t, 6>;
using RigidPoses = std::vector<RigidPose>;

inline Point3 TranslationOf(const RigidPose &pose)
{
   return {pose[0], pose[1], pose[2]};
}

inline Point3 RotationOf(const RigidPose &pose)
{
   return {pose[3], pose[4], pose[5]};
}

/// How a rigid body moves: three translations of its reference point and the
/// three components of its rotation vector.
struct RigidBodyOptions
{
   /// Moments are about it; the surfaces' center of area if it is not given.
   std::optional<Point3> reference;
   /// Prescribed (length, rad). None: the freedom is free, for its load and its
   /// spring.
   std::array<std::optional<LoadCurve>, 6> prescribed;
   /// When what is prescribed begins, if it is not where the body is, but how
   /// far it is from where it is then (RigidTies::SetOrigins()).
   std::optional<mfem::real_t> relative_since{};
   /// Force, and moment about the reference point (force, force x length).
   std::array<LoadCurve, 6> load{{0.0, 0.0, 0.0, 0.0, 0.0, 0.0}};
   /// Whether forces and moments turn with the body; they keep their directions
   /// in space otherwise.
   bool load_follows = false;
   /// Of springs between free freedoms and where these start (force / length,
   /// force x length / rad).
   std::array<mfem::real_t, 6> stiffness{{0.0, 0.0, 0.0, 0.0, 0.0, 0.0}};

   bool IsFree(int freedom) const { return !prescribed[freedom]; }
};

/// What makes no sense in the options; empty if there is nothing.
std::string Contradiction(const RigidBodyOptions &options,
                          Deformation deformation);

/// A rigid body: surfaces of deformable ones that are tied to it, and regions
/// that are part of it.
struct RigidBody
{
   /// In messages and output.
   std::string name;
   /// Those tied to it, and those of its regions alone.
   mfem::Array<int> boundary;
   RigidBodyOptions options;
   /// All of whose nodes are tied to it.
   mfem::Array<int> regions{};
};

} // namespace synovia
