#include "synovia/fem/rigid_frame.hpp"
#include "synovia/fem/rotation_vector.hpp"

namespace synovia
{

using namespace mfem;

namespace
{
DenseMatrix Identity()
{
   DenseMatrix identity(3);
   identity = 0.0;
   for (int d = 0; d < 3; d++)
   {
      identity(d, d) = 1.0;
   }
   return identity;
}
} // namespace

RigidFrame::RigidFrame(const RigidPose &pose, Deformation deformation)
   : finite(deformation == Deformation::finite),
     translation(TranslationOf(pose)), rotation(RotationOf(pose)),
     turn(finite ? RotationMatrix(rotation) : Identity()),
     spin(finite ? SpinMatrix(rotation) : Identity())
{
}

Point3 RigidFrame::Displacement(const Point3 &arm) const
{
   const Point3 turned =
      finite ? Sum(Times(turn, arm), -1.0, arm) : Cross(rotation, arm);
   return Sum(translation, 1.0, turned);
}

Point3 RigidFrame::Motion(int freedom, const Point3 &arm) const
{
   Point3 amount{{0.0, 0.0, 0.0}};
   amount[freedom % 3] = 1.0;
   return freedom < 3 ? amount : Cross(Times(spin, amount), Turned(arm));
}

Point3 RigidFrame::Turned(const Point3 &vector) const
{
   return Times(turn, vector);
}

} // namespace synovia
