#pragma once

#include "synovia/fem/rigid_body.hpp"
#include "synovia/materials/deformation.hpp"

namespace synovia
{

/// A rigid body in one pose, with the first derivatives of its motion. In
/// infinitesimal deformation the motion is linear.
class RigidFrame
{
public:
   RigidFrame(const RigidPose &pose, Deformation deformation);

   /// Displacement of a point, @a arm being from the reference point as meshed.
   Point3 Displacement(const Point3 &arm) const;
   /// A vector that turns with the body, such as an arm.
   Point3 Turned(const Point3 &vector) const;
   /// How it displaces that point, to first order, by an amount of 1 (length,
   /// rad) of one of its freedoms: translations, then components of the
   /// rotation vector.
   Point3 Motion(int freedom, const Point3 &arm) const;
   /// D in spin = D d(rotation vector).
   const mfem::DenseMatrix &Spin() const { return spin; }

private:
   bool finite;
   Point3 translation;
   Point3 rotation;
   mfem::DenseMatrix turn;
   mfem::DenseMatrix spin;
};

} // namespace synovia
