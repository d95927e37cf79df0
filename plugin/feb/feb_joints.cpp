#include "synovia/feb/feb_joints.hpp"

#include <algorithm>

namespace synovia
{

using namespace mfem;

namespace
{
/// A coordinate of Joint that is free unless a flag prescribes it.
struct JointFreedom
{
   int coordinate;
   std::string flag{};
   std::string value{};
};

/// The axis of flexion and what is across it by FEBio's names, if it has any,
/// and what it leaves free.
struct JointKind
{
   std::string type;
   std::string origin;
   std::string axis;
   std::string across;
   std::vector<JointFreedom> free;
};

// Of coordinates.
enum
{
   flexion,
   abduction,
   internal_rotation,
   lateral,
   anterior,
   distraction
};

const std::vector<JointKind> &JointKinds()
{
   static const std::vector<JointKind> kinds{
      {"rigid revolute joint",
       "joint_origin",
       "rotation_axis",
       "transverse_axis",
       {{flexion, "prescribed_rotation", "rotation"}}},
      {"rigid prismatic joint",
       "joint_origin",
       "translation_axis",
       "transverse_axis",
       {{lateral, "prescribed_translation", "translation"}}},
      {"rigid cylindrical joint",
       "joint_origin",
       "joint_axis",
       "transverse_axis",
       {{flexion, "prescribed_rotation", "rotation"},
        {lateral, "prescribed_translation", "translation"}}},
      {"rigid planar joint",
       "joint_origin",
       "rotation_axis",
       "translation_axis_1",
       {{flexion, "prescribed_rotation", "rotation"},
        {anterior},
        {distraction}}},
      {"rigid spherical joint",
       "joint_origin",
       "",
       "",
       {{flexion}, {abduction}, {internal_rotation}}},
      {"rigid joint",
       "joint",
       "",
       "",
       {{flexion}, {abduction}, {internal_rotation}}},
      {"rigid lock", "joint_origin", "first_axis", "second_axis", {}}};
   return kinds;
}

const JointKind *FindKind(const std::string &type)
{
   for (const JointKind &kind : JointKinds())
   {
      if (kind.type == type)
      {
         return &kind;
      }
   }
   return nullptr;
}

Point3 VectorOf(const FebInput &joint, const std::string &child,
                const Point3 &standard)
{
   const std::optional<FebInput> found =
      child.empty() ? std::nullopt : joint.Find(child);
   return found ? ReadVector(*found) : standard;
}

std::string BodyOf(const FebInput &joint, const std::string &child,
                   FebModel &model)
{
   const RigidBodyCase *body = model.FindRigid(joint.Word(child, ""), joint);
   return body ? body->name : "";
}

LoadCurve Reversed(const LoadCurve &curve)
{
   std::vector<real_t> values;
   for (const real_t t : curve.Corners())
   {
      values.push_back(-curve(t));
   }
   return LoadCurve(curve.Corners(), values);
}

void ReadFreedoms(const FebInput &joint, const JointKind &kind,
                  const FebModel &model, Joint &result)
{
   for (std::optional<LoadCurve> &prescribed : result.prescribed)
   {
      prescribed = LoadCurve(0.0);
   }
   for (const JointFreedom &freedom : kind.free)
   {
      std::optional<LoadCurve> &prescribed =
         result.prescribed[freedom.coordinate];
      prescribed.reset();
      if (freedom.flag.empty())
      {
         continue;
      }
      if (joint.Flag(freedom.flag, false))
      {
         // FEBio's axis is the reverse of that of flexion, about which the
         // distal body turns backwards.
         const LoadCurve value = model.Value(joint, freedom.value);
         prescribed = freedom.coordinate == lateral ? Reversed(value) : value;
      }
      else
      {
         joint.Ignore(freedom.value, "it is not prescribed");
      }
   }
}
} // namespace

bool IsJointType(const std::string &type)
{
   return FindKind(type) != nullptr;
}

std::string JointTypes()
{
   std::string types;
   for (const JointKind &kind : JointKinds())
   {
      types += (types.empty() ? "" : ", ") + kind.type;
   }
   return types;
}

void ReadJoint(const FebInput &joint, FebModel &model)
{
   for (const char *name :
        {"laugon", "tolerance", "gaptol", "angtol", "force_penalty",
         "moment_penalty", "penalty", "minaug", "maxaug", "auto_penalty"})
   {
      joint.Ignore(name, "multipliers hold what the joint holds");
   }
   for (const char *name :
        {"force", "moment", "moment_x", "moment_y", "moment_z", "force_damping",
         "moment_damping", "torsion_stiffness"})
   {
      joint.Expect(name, false,
                   "forces, damping and springs of joints are not known");
   }
   for (const char *name :
        {"prescribed_translation_1", "prescribed_translation_2"})
   {
      joint.Expect(name, false, "only the rotation can be prescribed here");
   }
   for (const char *name : {"translation_1", "translation_2"})
   {
      joint.Ignore(name, "it is not prescribed");
   }
   const JointKind &kind = *FindKind(joint.Attribute("type"));
   if (kind.axis.empty())
   {
      joint.Expect("prescribed_rotation", false,
                   "rotations of spherical joints are free");
      for (const char *name : {"rotation_x", "rotation_y", "rotation_z"})
      {
         joint.Ignore(name, "it is not prescribed");
      }
   }
   Joint result;
   const std::string name = joint.Attribute("name");
   result.name = name.empty()
                    ? "joint " + std::to_string(model.setup.joints.size() + 1)
                    : PlainName(name);
   result.proximal.body = BodyOf(joint, "body_a", model);
   result.distal.body = BodyOf(joint, "body_b", model);
   const Point3 axis =
      UnitVector(VectorOf(joint, kind.axis, {1.0, 0.0, 0.0}), joint);
   const Point3 across = VectorOf(joint, kind.across, {0.0, 1.0, 0.0});
   for (JointSide *side : {&result.proximal, &result.distal})
   {
      side->origin = VectorOf(joint, kind.origin, {0.0, 0.0, 0.0});
      side->flexion_axis = {-axis[0], -axis[1], -axis[2]};
      side->long_axis = across;
   }
   ReadFreedoms(joint, kind, model, result);
   model.setup.joints.push_back(result);
}

} // namespace synovia
