#include "synovia/cases/connection_keys.hpp"
#include "synovia/cases/key_names.hpp"

namespace synovia
{

namespace
{

KeyTable LigamentEndKeys(LigamentEnd &end)
{
   KeyTable keys;
   keys.Value("body", end.body, "",
              "the rigid body that it is attached to; space if left out");
   keys
      .Value("point", end.point, quantities::length,
             "where it is attached, as meshed; it need not be in a mesh")
      .Required();
   return keys;
}

KeyTable JointSideKeys(JointSide &side)
{
   KeyTable keys;
   keys.Value("body", side.body, "", "a rigid body; space if left out");
   keys
      .Value("origin", side.origin, quantities::length,
             "the point that translations are of, as meshed")
      .Required();
   keys.Value("flexion_axis", side.flexion_axis, "",
              "mediolateral, towards the right of the subject, as meshed");
   keys.Value("long_axis", side.long_axis, "",
              "towards the proximal end of the bone, as meshed");
   return keys;
}
} // namespace

KeyTable LigamentKeys(Ligament &ligament)
{
   KeyTable keys;
   keys.Value("name", ligament.name, "", "of the ligament in the output")
      .Required();
   keys.Table("from", LigamentEndKeys(ligament.from), "one end");
   keys.Table("to", LigamentEndKeys(ligament.to), "the other end");
   LigamentOptions &options = ligament.options;
   keys
      .Value("stiffness", options.stiffness, "force/length",
             "beyond the toe region; 0 where strain_stiffness says it")
      .AtLeast(0.0);
   keys
      .Value("strain_stiffness", options.strain_stiffness, "force",
             "instead: force per strain beyond the toe region")
      .AtLeast(0.0);
   keys.Auto("slack_length", options.slack_length, quantities::length,
             "where the force begins; the length as meshed, less the "
             "prestrain");
   keys
      .Value("prestrain", options.prestrain, "",
             "strain as meshed, negative where it is slack")
      .In(NumberRange::Above(-1.0));
   keys
      .Value("toe_strain", options.toe_strain, "",
             "where the toe region ends, in which the force grows with the "
             "square of the strain; 0: there is none")
      .AtLeast(0.0);
   keys.Value("compression", options.compression, "",
              "whether it resists being shorter than its slack length, too, as "
              "a spring does");
   return keys;
}

KeyTable JointKeys(Joint &joint)
{
   KeyTable keys;
   keys.Value("name", joint.name, "", "of the joint in the output").Required();
   keys.Table("proximal", JointSideKeys(joint.proximal),
              "the bone that flexion is about an axis of, such as the femur");
   keys.Table("distal", JointSideKeys(joint.distal),
              "the bone whose long axis it turns about, such as the tibia");
   keys.Word<JointOf>("side", joint.of,
                      {{"right", JointOf::right}, {"left", JointOf::left}},
                      "of the body");
   const std::array<std::string, 6> meanings{
      {"prescribed flexion; free if left out, as all that follow",
       "about the floating axis; positive where the distal end goes outwards",
       "about the long axis of the distal bone, inwards positive",
       "translation of the distal origin along the axis of flexion, outwards "
       "positive",
       "along the floating axis, forwards positive",
       "along the long axis of the distal bone, apart positive"}};
   for (int k = 0; k < 6; k++)
   {
      keys.Value(JointCoordinateNames()[k], joint.prescribed[k],
                 k < 3 ? "rad" : quantities::length, meanings[k]);
   }
   return keys;
}

} // namespace synovia
