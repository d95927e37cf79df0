// ranks: 1
//
// Coordinates of joints after Grood & Suntay (1983): with the elementary turns
// by them the axes of the distal bone follow from those of the proximal one,
//
//     [i j k] = [I J K] X(-flexion) Y(-abduction) Z(internal rotation)
//
// for a right joint, Y and Z being the other way round for a left one; and
// derivatives against central differences.

#include "synovia/fem/joint_coordinates.hpp"
#include "synovia/fem/rotation_vector.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <random>

using namespace mfem;
using namespace synovia;

namespace
{
using Coordinates = std::array<real_t, 6>;

Coordinates ValuesOf(const Joint &joint, const BonePose &proximal,
                     const BonePose &distal,
                     Deformation deformation = Deformation::finite)
{
   Coordinates values;
   const auto all = JointCoordinates(joint, proximal, distal, deformation);
   for (int i = 0; i < 6; i++)
   {
      values[i] = all[i].value;
   }
   return values;
}

DenseMatrix Product(const DenseMatrix &a, const DenseMatrix &b)
{
   DenseMatrix product(3);
   Mult(a, b, product);
   return product;
}

DenseMatrix Columns(const Point3 &a, const Point3 &b, const Point3 &c)
{
   DenseMatrix columns(3);
   for (int i = 0; i < 3; i++)
   {
      columns(i, 0) = a[i];
      columns(i, 1) = b[i];
      columns(i, 2) = c[i];
   }
   return columns;
}

Point3 Unit(const Point3 &a)
{
   return Sum({{0.0, 0.0, 0.0}}, 1.0 / Length(a), a);
}

BonePose RandomBone(std::mt19937 &random, real_t largest_angle)
{
   std::uniform_real_distribution<real_t> number(-1.0, 1.0);
   BonePose bone;
   for (int d = 0; d < 3; d++)
   {
      bone.pose[d] = number(random);
      bone.pose[d + 3] = number(random);
      bone.reference[d] = number(random);
   }
   const real_t angle = Length(RotationOf(bone.pose));
   for (int d = 3; d < 6; d++)
   {
      bone.pose[d] *= largest_angle / angle;
   }
   return bone;
}

Point3 Placed(const BonePose &bone, const Point3 &point)
{
   const Point3 turned = Times(RotationMatrix(RotationOf(bone.pose)),
                               Sum(point, -1.0, bone.reference));
   return Sum(Sum(bone.reference, 1.0, TranslationOf(bone.pose)), 1.0, turned);
}

// With axes that are neither alike nor at right angles.
Joint Skewed(JointOf side)
{
   Joint joint;
   joint.of = side;
   joint.proximal.origin = {{0.1, -0.2, 0.4}};
   joint.proximal.flexion_axis = {{2.0, 0.3, -0.2}};
   joint.proximal.long_axis = {{0.1, -0.2, 0.7}};
   joint.distal.origin = {{-0.3, 0.1, 0.2}};
   joint.distal.flexion_axis = {{0.9, -0.1, 0.2}};
   joint.distal.long_axis = {{-0.1, 0.3, 3.0}};
   return joint;
}
} // namespace

TEST_CASE("Coordinates turn the axes of one bone into those of the other")
{
   const JointOf side = GENERATE(JointOf::right, JointOf::left);
   const real_t angle = GENERATE(1e-9, 1e-3, 0.5, 0.99, 1.01, 2.5, 7.0);
   CAPTURE(static_cast<int>(side), angle);
   const real_t outwards = side == JointOf::right ? 1.0 : -1.0;
   const Joint joint = Skewed(side);
   std::mt19937 random(3);
   for (int trial = 0; trial < 20; trial++)
   {
      const BonePose proximal = RandomBone(random, angle);
      const BonePose distal = RandomBone(random, 0.7 * angle);
      const Coordinates q = ValuesOf(joint, proximal, distal);
      const Point3 right = Unit(joint.proximal.flexion_axis);
      const Point3 front = Unit(Cross(joint.proximal.long_axis, right));
      const DenseMatrix femur =
         Product(RotationMatrix(RotationOf(proximal.pose)),
                 Columns(right, front, Cross(right, front)));
      const Point3 up = Unit(joint.distal.long_axis);
      const Point3 ahead = Unit(Cross(up, joint.distal.flexion_axis));
      const DenseMatrix tibia = Product(RotationMatrix(RotationOf(distal.pose)),
                                        Columns(Cross(ahead, up), ahead, up));
      const DenseMatrix flexed =
         Product(femur, RotationMatrix({{-q[0], 0.0, 0.0}}));
      const DenseMatrix abducted =
         Product(flexed, RotationMatrix({{0.0, -outwards * q[1], 0.0}}));
      DenseMatrix turned =
         Product(abducted, RotationMatrix({{0.0, 0.0, outwards * q[2]}}));
      turned -= tibia;
      CHECK(turned.MaxMaxNorm() < 1e-12);

      const Point3 apart = Sum(Placed(distal, joint.distal.origin), -1.0,
                               Placed(proximal, joint.proximal.origin));
      const auto along = [&](const DenseMatrix &axes, int d)
      {
         return apart[0] * axes(0, d) + apart[1] * axes(1, d) +
                apart[2] * axes(2, d);
      };
      CHECK(q[3] == Approx(outwards * along(femur, 0)).margin(1e-12));
      CHECK(q[4] == Approx(along(flexed, 1)).margin(1e-12));
      CHECK(q[5] == Approx(-along(tibia, 2)).margin(1e-12));
   }
}

TEST_CASE("Signs are those of the clinic")
{
   // Subjects look along y, z is up, x to the right; the femur rests.
   Joint knee;
   const auto turned = [&](const Point3 &rotation)
   {
      BonePose tibia;
      std::copy(rotation.begin(), rotation.end(), tibia.pose.begin() + 3);
      return ValuesOf(knee, {}, tibia);
   };
   const auto moved = [&](const Point3 &translation)
   {
      BonePose tibia;
      std::copy(translation.begin(), translation.end(), tibia.pose.begin());
      return ValuesOf(knee, {}, tibia);
   };
   const real_t angle = 0.3;
   // The foot, at -z, goes back.
   CHECK(turned({{-angle, 0.0, 0.0}})[0] == Approx(angle));
   // The foot of a right leg goes to the right, that is outwards.
   CHECK(turned({{0.0, -angle, 0.0}})[1] == Approx(angle));
   // Its toes, at y, go to the left, that is inwards.
   CHECK(turned({{0.0, 0.0, angle}})[2] == Approx(angle));
   CHECK(moved({{0.2, 0.0, 0.0}})[3] == Approx(0.2));
   CHECK(moved({{0.0, 0.2, 0.0}})[4] == Approx(0.2));
   CHECK(moved({{0.0, 0.0, -0.2}})[5] == Approx(0.2));
   knee.of = JointOf::left;
   CHECK(turned({{-angle, 0.0, 0.0}})[0] == Approx(angle));
   CHECK(turned({{0.0, angle, 0.0}})[1] == Approx(angle));
   CHECK(turned({{0.0, 0.0, -angle}})[2] == Approx(angle));
   CHECK(moved({{-0.2, 0.0, 0.0}})[3] == Approx(0.2));
   CHECK(moved({{0.0, 0.2, 0.0}})[4] == Approx(0.2));
   // Beyond a right angle.
   CHECK(turned({{-2.5, 0.0, 0.0}})[0] == Approx(2.5));
}

TEST_CASE("Derivatives of coordinates are those of central differences")
{
   const JointOf side = GENERATE(JointOf::right, JointOf::left);
   const Deformation deformation =
      GENERATE(Deformation::finite, Deformation::infinitesimal);
   const real_t angle = GENERATE(0.0, 1e-4, 0.4, 0.9, 3.0);
   CAPTURE(static_cast<int>(side), static_cast<int>(deformation), angle);
   const Joint joint = Skewed(side);
   std::mt19937 random(5);
   const std::array<BonePose, 2> bones{
      {RandomBone(random, angle), RandomBone(random, 1.3 * angle)}};
   const auto at = [&](int variable, real_t step)
   {
      std::array<BonePose, 2> moved = bones;
      moved[variable / 6].pose[variable % 6] += step;
      return JointCoordinates(joint, moved[0], moved[1], deformation);
   };
   const auto here = JointCoordinates(joint, bones[0], bones[1], deformation);
   constexpr real_t step = 1e-5;
   for (int a = 0; a < 12; a++)
   {
      const auto ahead = at(a, step);
      const auto behind = at(a, -step);
      for (int c = 0; c < 6; c++)
      {
         CAPTURE(a, c);
         const real_t slope = 0.5 * (ahead[c].value - behind[c].value) / step;
         CHECK(here[c].first[a] == Approx(slope).epsilon(1e-7).margin(1e-8));
         for (int b = 0; b < 12; b++)
         {
            const real_t curvature =
               0.5 * (ahead[c].first[b] - behind[c].first[b]) / step;
            CHECK(here[c].second[a][b] ==
                  Approx(curvature).epsilon(1e-7).margin(1e-7));
            CHECK(here[c].second[a][b] ==
                  Approx(here[c].second[b][a]).margin(1e-12));
         }
      }
   }
}

TEST_CASE("Rotations of one theory are those of the other, if they are small")
{
   const Joint joint = Skewed(JointOf::right);
   std::mt19937 random(7);
   BonePose distal = RandomBone(random, 1.0);
   for (real_t &freedom : distal.pose)
   {
      freedom *= 1e-6;
   }
   const Coordinates finite = ValuesOf(joint, {}, distal);
   const Coordinates linear =
      ValuesOf(joint, {}, distal, Deformation::infinitesimal);
   for (int c = 0; c < 6; c++)
   {
      CHECK(finite[c] == Approx(linear[c]).margin(1e-11));
   }
}
