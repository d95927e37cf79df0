#include "synovia/fem/joint_coordinates.hpp"

namespace synovia
{

using namespace mfem;

namespace
{
using Scalar = SecondOrder<12>;
using Vector3D = std::array<Scalar, 3>;

Scalar DotProduct(const Vector3D &a, const Vector3D &b)
{
   return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

Vector3D CrossProduct(const Vector3D &a, const Vector3D &b)
{
   return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
           a[0] * b[1] - a[1] * b[0]};
}

Vector3D Combined(const Vector3D &a, const Scalar &s, const Vector3D &b)
{
   return {a[0] + s * b[0], a[1] + s * b[1], a[2] + s * b[2]};
}

Vector3D Constant(const Point3 &a)
{
   return {a[0], a[1], a[2]};
}

// Stumpff's functions c_k(s) = 1/k! - s/(k+2)! + s^2/(k+4)! - ... up to k = 6:
// cos a, sin a / a, (1 - cos a)/a^2, ... of s = a^2.
std::array<real_t, 7> Stumpff(real_t s)
{
   std::array<real_t, 7> c{};
   constexpr real_t small = 1.0;
   if (s < small)
   {
      constexpr int terms = 10;
      real_t factorial = 1.0;
      for (int k = 0; k < 7; k++)
      {
         factorial *= k > 0 ? k : 1;
         real_t term = 1.0 / factorial;
         for (int j = 1; j <= terms; j++)
         {
            c[k] += term;
            term *= -s / ((k + 2 * j - 1) * (k + 2 * j));
         }
      }
      return c;
   }
   const real_t a = std::sqrt(s);
   c[0] = std::cos(a);
   c[1] = std::sin(a) / a;
   real_t factorial = 1.0;
   for (int k = 2; k < 7; k++)
   {
      factorial *= k > 2 ? k - 2 : 1;
      c[k] = (1.0 / factorial - c[k - 2]) / s;
   }
   return c;
}

// c_k of a number, by dc_k/ds = (k c_(k+2) - c_(k+1))/2.
Scalar Stumpff(int k, const Scalar &s, const std::array<real_t, 7> &c)
{
   const auto slope = [&](int i) { return 0.5 * (i * c[i + 2] - c[i + 1]); };
   return Composed(s, c[k], slope(k), 0.5 * (k * slope(k + 2) - slope(k + 1)));
}

/// A bone in its pose.
class Bone
{
public:
   // The variables of its pose begin with @a first.
   Bone(const BonePose &bone, int first, Deformation deformation_)
      : deformation(deformation_), reference(Constant(bone.reference))
   {
      for (int d = 0; d < 3; d++)
      {
         translation[d] = Scalar::Variable(first + d, bone.pose[d]);
         rotation[d] = Scalar::Variable(first + 3 + d, bone.pose[d + 3]);
      }
      const Scalar s = DotProduct(rotation, rotation);
      const std::array<real_t, 7> c = Stumpff(s.value);
      for (int k = 0; k < 3; k++)
      {
         of_angle[k] = Stumpff(k, s, c);
      }
   }

   // Rodrigues.
   Vector3D Turned(const Point3 &vector) const
   {
      const Vector3D a = Constant(vector);
      Vector3D turned = Combined({}, of_angle[0], a);
      turned = Combined(turned, of_angle[1], CrossProduct(rotation, a));
      return Combined(turned, of_angle[2] * DotProduct(rotation, a), rotation);
   }

   Vector3D Place(const Point3 &point) const
   {
      Point3 arm{};
      for (int d = 0; d < 3; d++)
      {
         arm[d] = point[d] - reference[d].value;
      }
      const Vector3D turned =
         deformation == Deformation::finite
            ? Turned(arm)
            : Combined(Constant(arm), 1.0,
                       CrossProduct(rotation, Constant(arm)));
      return Combined(Combined(reference, 1.0, translation), 1.0, turned);
   }

private:
   Deformation deformation;
   Vector3D reference;
   Vector3D translation;
   Vector3D rotation;
   std::array<Scalar, 3> of_angle;
};

// Unit vectors as meshed: right, anterior, proximal.
struct Axes
{
   Point3 right;
   Point3 anterior;
   Point3 proximal;
};

Point3 Unit(const Point3 &a)
{
   return Sum({{0.0, 0.0, 0.0}}, 1.0 / Length(a), a);
}

Axes AxesOf(const JointSide &side, bool keeps_flexion_axis)
{
   const Point3 anterior = Unit(Cross(side.long_axis, side.flexion_axis));
   const Point3 right = keeps_flexion_axis
                           ? Unit(side.flexion_axis)
                           : Cross(anterior, Unit(side.long_axis));
   return {right, anterior, Cross(right, anterior)};
}
} // namespace

std::array<SecondOrder<12>, 6> JointCoordinates(const Joint &joint,
                                                const BonePose &proximal,
                                                const BonePose &distal,
                                                Deformation deformation)
{
   const Bone femur(proximal, 0, deformation);
   const Bone tibia(distal, 6, deformation);
   const Axes of_femur = AxesOf(joint.proximal, true);
   const Axes of_tibia = AxesOf(joint.distal, false);
   const Vector3D I = femur.Turned(of_femur.right);
   const Vector3D k = tibia.Turned(of_tibia.proximal);
   const Vector3D floating = CrossProduct(k, I);
   const Scalar length = Sqrt(DotProduct(floating, floating));
   const Scalar flexion =
      Atan2(-DotProduct(floating, femur.Turned(of_femur.proximal)),
            DotProduct(floating, femur.Turned(of_femur.anterior)));
   const Scalar abduction = -Atan2(DotProduct(I, k), length);
   const Scalar internal =
      Atan2(DotProduct(floating, tibia.Turned(of_tibia.right)),
            DotProduct(floating, tibia.Turned(of_tibia.anterior)));
   const Vector3D apart = Combined(tibia.Place(joint.distal.origin), -1.0,
                                   femur.Place(joint.proximal.origin));
   const real_t side = joint.of == JointOf::right ? 1.0 : -1.0;
   return {flexion,
           side * abduction,
           side * internal,
           side * DotProduct(apart, I),
           DotProduct(apart, floating) * Inverse(length),
           -DotProduct(apart, k)};
}

} // namespace synovia
