#include "synovia/cases/condition_keys.hpp"
#include "synovia/cases/key_names.hpp"

namespace synovia
{

namespace
{

KeyTable SpringKeys(SpringCase &spring)
{
   KeyTable keys;
   keys
      .Value("stiffness", spring.stiffness, "force/length",
             "of all springs together, spread over the surfaces; 0 for none")
      .AtLeast(0.0);
   keys.Value("direction", spring.direction, "",
              "of the springs; [0, 0, 0] for alike in all directions");
   return keys;
}

KeyTable ForceKeys(ForceCase &force)
{
   KeyTable keys;
   keys.Value("direction", force.direction, "",
              "of the resultant; components of the displacement that are zero "
              "here are free, or as displacement says");
   keys.Value("curve", force.curve, "force", "the resultant in time");
   return keys;
}

void AddBoundaryKeys(BoundaryCase &boundary, KeyTable &keys)
{
   keys.Value("displacement", boundary.displacement, quantities::length,
              "prescribed, by component");
   keys.Value("pressure", boundary.pressure, quantities::stress,
              "prescribed fluid pressure; impermeable if there is none");
   keys.Value("traction", boundary.traction, quantities::stress,
              "total traction, by component");
   keys.Value("normal_traction", boundary.normal_traction, quantities::stress,
              "total traction along the outward normal, positive in tension; "
              "in finite deformation it follows the surface");
   keys.Value("effective_traction", boundary.effective_traction,
              quantities::stress,
              "traction of the solid alone along the outward normal, to which "
              "the fluid's pressure adds: the total one is less by the "
              "pressure; finite deformation");
   keys.Value("sealed", boundary.sealed, "",
              "whether no fluid passes where nothing touches, of surfaces of "
              "contact pairs, which drain there otherwise");
   keys.Value("normal_flux", boundary.normal_flux, "length/time",
              "outward relative flux of the fluid; in finite deformation per "
              "deformed area");
   keys.Value("mixture_flux", boundary.mixture_flux, "length/time",
              "outward flux of fluid and solid together, per deformed area: "
              "the relative one is less by the solid's velocity; finite "
              "deformation");
   keys.Table("spring", SpringKeys(boundary.spring),
              "springs between the surfaces and a fixed base");
   keys.Value("guide", boundary.guide, "",
              "across a plane that the surfaces keep to and slide along, for "
              "planes of symmetry across no axis: springs hold them that give "
              "way by less than a hundred thousandth of the body's strain");
   keys.Table("force", ForceKeys(boundary.force),
              "moves the surfaces rigidly, as one, by a resultant");
}

void AddRigidBodyKeys(RigidBodyCase &body, KeyTable &keys)
{
   keys.Value("translation", body.translation, quantities::length,
              "prescribed, by component; free if left out");
   keys.Value("rotation", body.rotation, "rad",
              "prescribed, by component of the rotation vector, which is along "
              "the axis and as long as the angle; free if left out");
   keys.Value("force", body.force, "force",
              "at the reference point, by component, on free ones");
   keys.Value("moment", body.moment, "force length",
              "about the reference point, by component, on free ones");
   keys.Value("load_follows", body.load_follows, "",
              "whether force and moment turn with the body, in finite "
              "deformation");
   keys.Value("stiffness", body.stiffness, "force/length",
              "of springs between the reference point and where it was, by "
              "component, on free ones");
   keys.Value("rotational_stiffness", body.rotational_stiffness,
              "force length/rad",
              "of springs that resist rotation, by component, on free ones");
}

KeyTable FrictionKeys(FrictionOptions &options)
{
   KeyTable keys;
   keys
      .Value("coefficient", options.coefficient, "",
             "mu_eq, that without fluid pressure; 0: frictionless")
      .AtLeast(0.0);
   keys
      .Auto("solid_fraction", options.solid_fraction, "",
            "phi, the part of the contact area where solid meets solid; the "
            "product of the solid fractions of both sides")
      .From(0.0, 1.0);
   return keys;
}

void AddContactKeys(ContactOptions &options, KeyTable &keys)
{
   keys.Auto("penalty", options.penalty, "stress/length",
             "of the gap; derived from the softer side");
   keys.Auto("pressure_penalty", options.pressure_penalty,
             "length/(stress time)",
             "of the pressure jump; derived from the less permeable side");
   keys
      .Value("penalty_factor", options.penalty_factor, "",
             "factor of both derived penalties")
      .Positive()
      .Named("penalty_factor");
   keys.Auto("gap_tolerance", options.gap_tolerance, quantities::length,
             "largest gap left in contact; 1e-5 of the destination's "
             "thickness");
   keys
      .Value("pressure_tolerance", options.pressure_tolerance, "",
             "largest pressure jump left in contact, of the peak pressure")
      .Positive();
   keys.Auto("search_radius", options.search_radius, quantities::length,
             "how far the destination looks for the source; the destination's "
             "thickness");
   keys.Word<InitialOverlap>("initial_overlap", options.initial_overlap,
                             {{"press_out", InitialOverlap::press_out},
                              {"remove", InitialOverlap::remove}},
                             "what becomes of surfaces that overlap as meshed: "
                             "the first step presses it out, or gaps are "
                             "measured from it");
   keys.Auto("overlap_limit", options.overlap_limit, quantities::length,
             "a deeper overlap is an error; a tenth of the destination's "
             "thickness");
   keys.Word<SearchConfiguration>(
      "configuration", options.configuration,
      {{"reference", SearchConfiguration::reference},
       {"current", SearchConfiguration::current}},
      "where the surfaces look for each other: as meshed, once, or as "
      "deformed, in every step, for large sliding");
   keys.Word<ContactNormal>(
      "normal", options.normal,
      {{"destination", ContactNormal::destination},
       {"mean", ContactNormal::mean}},
      "the direction of gap and traction: the destination's normal, or the "
      "mean of both surfaces'");
   keys.Table("friction", FrictionKeys(options.friction),
              "Coulomb's, on the share of the load that the solids bear, in "
              "finite deformation");
   keys.Word<DryPartner>(
      "fluid", options.dry_partner,
      {{"impermeable", DryPartner::impermeable},
       {"draining", DryPartner::draining}},
      "where one side has no fluid, what that is to the other's fluid while "
      "they touch: none passes, or it leaves as where nothing touches; without "
      "effect where both have fluid, which passes between them");
   keys
      .Value(
         "quadrature_order", options.quadrature_order, "",
         "exactness of the quadrature on the part of a face that one face of "
         "the source covers; not 3")
      .From(1, 25);
}
} // namespace

KeyTable BoundaryKeys(BoundaryCase &boundary)
{
   KeyTable keys;
   keys.Value("name", boundary.name, "", "by which steps change or release it");
   keys.Value("surfaces", boundary.surfaces, "", "where: physical surfaces")
      .Required();
   AddBoundaryKeys(boundary, keys);
   return keys;
}

KeyTable StepBoundaryKeys(BoundaryCase &boundary)
{
   KeyTable keys;
   keys.Value("name", boundary.name, "",
              "what is of this name already ends; a later step may change or "
              "release it");
   keys.Value("surfaces", boundary.surfaces, "",
              "where: physical surfaces; those of what it takes the place of "
              "if left out");
   keys.Value("relative", boundary.relative, "",
              "whether the displacement counts from where the surfaces are "
              "when the step begins");
   AddBoundaryKeys(boundary, keys);
   return keys;
}

namespace
{
void AddRound(RigidShape &shape, KeyTable &keys)
{
   keys.Value("radius", shape.radius, quantities::length, "of it")
      .Required()
      .Positive();
   keys.Value("hollow", shape.hollow, "",
              "whether it is a hole that others touch from inside");
}

KeyTable ShapeKeysOf(RigidShape::Type type, RigidShape &shape)
{
   KeyTable keys;
   switch (type)
   {
   case RigidShape::Type::none:
      return keys;
   case RigidShape::Type::plane:
      keys.Value("center", shape.center, quantities::length, "of the square")
         .Required();
      keys.Value("normal", shape.axis, "",
                 "towards what it touches, of any length");
      keys.Value("edge", shape.edge, quantities::length, "of the square")
         .Required()
         .Positive();
      break;
   case RigidShape::Type::sphere:
      keys.Value("center", shape.center, quantities::length, "of it")
         .Required();
      AddRound(shape, keys);
      break;
   case RigidShape::Type::cylinder:
      keys
         .Value("center", shape.center, quantities::length,
                "the middle of its axis")
         .Required();
      keys.Value("axis", shape.axis, "", "its direction, of any length");
      keys.Value("height", shape.height, quantities::length, "along the axis")
         .Required()
         .Positive();
      AddRound(shape, keys);
      break;
   case RigidShape::Type::file:
      keys
         .Value("file", shape.file, "",
                "STL, or MSH with surface elements, relative to the directory "
                "of the case file")
         .Required();
      keys.Value("scale", shape.scale, "", "factor on all coordinates")
         .Positive();
      return keys;
   }
   keys.Auto("facet_size", shape.facet_size, quantities::length,
             "of the facets it is made of, which are curved where it is round; "
             "an eighth of the radius, a quarter of the edge");
   return keys;
}

KeyTable ShapeKeys(RigidShape &shape)
{
   using Type = RigidShape::Type;
   KeyTable keys;
   keys.Choice<Type>(
      "type", shape.type,
      {{"none", Type::none},
       {"plane", Type::plane},
       {"sphere", Type::sphere},
       {"cylinder", Type::cylinder},
       {"file", Type::file}},
      {"only surfaces and regions of the mesh", "a square", "a sphere",
       "a cylinder with flat ends", "a surface from a file"},
      [&shape](Type type) { return ShapeKeysOf(type, shape); },
      "kind of shape, one of:");
   return keys;
}
} // namespace

KeyTable RigidBodyKeys(RigidBodyCase &body)
{
   KeyTable keys;
   keys.Value("name", body.name, "", "of the body in the output").Required();
   keys.Value("surfaces", body.surfaces, "",
              "what is tied to it: physical surfaces");
   keys.Value("regions", body.regions, "",
              "what is part of it: physical volumes without a material");
   keys.Table("shape", ShapeKeys(body.shape),
              "a surface without a mesh, to touch others with: contact pairs "
              "know it by the body's name; of a cylinder also NAME_side and "
              "NAME_ends");
   keys.Value("reference", body.reference, quantities::length,
              "the point that the translation and moments are of; the shape's "
              "center, or the surfaces' center of area if left out");
   AddRigidBodyKeys(body, keys);
   return keys;
}

KeyTable StepRigidBodyKeys(RigidBodyCase &body)
{
   KeyTable keys;
   keys.Value("name", body.name, "", "of a rigid body that there is")
      .Required();
   keys.Value("relative", body.relative, "",
              "whether translation and rotation count from where the body is "
              "when the step begins");
   AddRigidBodyKeys(body, keys);
   return keys;
}

KeyTable ContactKeys(ContactCase &contact)
{
   KeyTable keys;
   keys.Value("name", contact.name, "",
              "of the pair in the output; made of source and destination if "
              "left out");
   keys.Value("source", contact.source, "", "physical surfaces of one side")
      .Required();
   keys
      .Value("destination", contact.destination, "",
             "physical surfaces of the other side, which carries the contact "
             "traction: the finer one")
      .Required();
   AddContactKeys(contact.options, keys);
   return keys;
}

KeyTable TieKeys(TieCase &tie)
{
   KeyTable keys;
   keys.Value("name", tie.name, "",
              "of the tie in the output; made of source and destination if "
              "left out");
   keys.Value("source", tie.source, "", "physical surfaces of one side")
      .Required();
   keys
      .Value("destination", tie.destination, "",
             "physical surfaces of the other side, which carries the "
             "tractions: the finer one")
      .Required();
   TieOptions &options = tie.options;
   keys.Auto("search_radius", options.search_radius, quantities::length,
             "how far the undeformed surfaces look for each other; half of the "
             "thickness of the thinner layer");
   keys.Auto("displacement_tolerance", options.displacement_tolerance,
             quantities::length,
             "largest difference of the displacements left; 1e-6 of the "
             "thickness of the thinner layer");
   keys
      .Value("pressure_tolerance", options.pressure_tolerance, "",
             "largest difference of the fluid's pressures left, as a fraction "
             "of the peak pressure")
      .Positive();
   return keys;
}

} // namespace synovia
