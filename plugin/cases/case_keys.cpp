#include "synovia/cases/case_keys.hpp"
#include "synovia/cases/law_keys.hpp"
#include "synovia/cases/tuning_keys.hpp"

namespace synovia
{

using namespace mfem;

namespace
{
// More would not be a mesh or a space that fits into any memory.
constexpr int most_refinements = 6;
constexpr int highest_order = 8;
constexpr int most_points = 100000;

const char *const length = "length";
const char *const stress = "stress";
const char *const time_unit = "time";

KeyTable MeshKeys(MeshCase &mesh)
{
   KeyTable keys;
   keys
      .Value("file", mesh.file, "",
             "gmsh mesh, relative to the directory of the case file")
      .Required();
   keys.Value("scale", mesh.options.scale, "", "factor on all coordinates")
      .Positive();
   keys
      .Value("refine", mesh.options.refine, "",
             "how often every element is split uniformly")
      .From(0, most_refinements);
   keys.Value("generator", mesh.generator, "",
              "what makes the mesh: a script in meshes/ and its arguments; "
              "scripts/run CASE.toml runs it, synovia never does");
   return keys;
}

KeyTable SpaceKeys(SpaceOptions &space)
{
   KeyTable keys;
   keys
      .Value("order", space.order, "",
             "order of the displacement, the pressure has one less; 1 is "
             "stabilized equal order")
      .From(1, highest_order)
      .Named("the order of the displacement");
   keys
      .Value("stabilization", space.stabilization, "",
             "factor on the stabilization of order 1; 0: none, then pressures "
             "oscillate in steps in which hardly any fluid moves")
      .From(0.0, 1.0)
      .Named("the stabilization");
   return keys;
}

KeyTable PhysicsKeys(SpaceOptions &space)
{
   KeyTable keys;
   keys.Word<Deformation>("deformation", space.deformation, DeformationWords(),
                          "of all bodies; it says which laws there are");
   return keys;
}

KeyTable FrameKeysOf(FrameType type, FrameCase &frame)
{
   KeyTable keys;
   switch (type)
   {
   case FrameType::cartesian:
      keys.Value("axis", frame.axis, "", "direction of the fibers");
      break;
   case FrameType::cylindrical:
      keys.Value("axis", frame.axis, "",
                 "direction of the axis, about which fibers run");
      keys.Value("origin", frame.origin, length, "point on the axis");
      keys.Value("between", frame.between, "",
                 "instead of the origin: it is midway between the centers of "
                 "these surfaces");
      keys.Value("around", frame.around, "",
                 "instead of the origin: it is at the center of the circle "
                 "that fits these surfaces, seen along the axis");
      break;
   case FrameType::field:
      keys
         .Value("name", frame.name, "",
                "of the vectors in the mesh file ($ElementData of gmsh), "
                "along which fibers run in each element")
         .Required();
      break;
   case FrameType::projected:
      keys
         .Value("direction", frame.direction, "",
                "the vector along whose projection on the surfaces fibers run")
         .Required();
      keys
         .Value("surfaces", frame.surfaces, "",
                "what it is projected on: in each element the nearest point "
                "counts, z is the outward normal there")
         .Required();
      break;
   }
   return keys;
}

KeyTable FrameKeys(FrameCase &frame)
{
   KeyTable keys;
   keys.Choice<FrameType>(
      "type", frame.type,
      {{"cartesian", FrameType::cartesian},
       {"cylindrical", FrameType::cylindrical},
       {"field", FrameType::field},
       {"projected", FrameType::projected}},
      {"the same everywhere", "around an axis",
       "along a vector that the mesh file has for each element",
       "along surfaces"},
      [&frame](FrameType type) { return FrameKeysOf(type, frame); },
      "kind of axes, one of:");
   return keys;
}

KeyTable MaterialKeys(MaterialCase &material)
{
   KeyTable keys;
   keys.Value("regions", material.regions, "", "where: physical volumes")
      .Required();
   keys.Table("solid", SolidKeys(material.solid), "");
   keys.Table("permeability", PermeabilityKeys(material.permeability), "");
   keys
      .Value("solid_fraction", material.solid_fraction, "",
             "volume fraction of the solid")
      .Inside(0.0, 1.0)
      .Named("the solid fraction");
   keys.Table("frame", FrameKeys(material.frame),
              "axes r, theta, z of fibers, of the undeformed body");
   return keys;
}

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

KeyTable BoundaryKeys(BoundaryCase &boundary)
{
   KeyTable keys;
   keys.Value("surfaces", boundary.surfaces, "", "where: physical surfaces")
      .Required();
   keys.Value("displacement", boundary.displacement, length,
              "prescribed, by component");
   keys.Value("pressure", boundary.pressure, stress,
              "prescribed fluid pressure; impermeable if there is none");
   keys.Value("traction", boundary.traction, stress,
              "total traction, by component");
   keys.Value("normal_traction", boundary.normal_traction, stress,
              "total traction along the outward normal, positive in tension; "
              "in finite deformation it follows the surface");
   keys.Value("effective_traction", boundary.effective_traction, stress,
              "traction of the solid alone along the outward normal, to which "
              "the fluid's pressure adds: the total one is less by the "
              "pressure; finite deformation");
   keys.Value("normal_flux", boundary.normal_flux, "length/time",
              "outward relative flux of the fluid; in finite deformation per "
              "deformed area");
   keys.Value("mixture_flux", boundary.mixture_flux, "length/time",
              "outward flux of fluid and solid together, per deformed area: "
              "the relative one is less by the solid's velocity; finite "
              "deformation");
   keys.Table("spring", SpringKeys(boundary.spring),
              "springs between the surfaces and a fixed base");
   keys.Table("force", ForceKeys(boundary.force),
              "moves the surfaces rigidly, as one, by a resultant");
   return keys;
}

KeyTable RigidBodyKeys(RigidBodyCase &body)
{
   KeyTable keys;
   keys.Value("name", body.name, "", "of the body in the output").Required();
   keys
      .Value("surfaces", body.surfaces, "",
             "what is tied to it: physical surfaces")
      .Required();
   keys.Value("reference", body.reference, length,
              "the point that the translation and moments are of; the "
              "surfaces' center of area if left out");
   keys.Value("translation", body.translation, length,
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
   return keys;
}

KeyTable ContactKeys(ContactCase &contact)
{
   ContactOptions &options = contact.options;
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
   keys.Auto("gap_tolerance", options.gap_tolerance, length,
             "largest gap left in contact; 1e-5 of the destination's "
             "thickness");
   keys
      .Value("pressure_tolerance", options.pressure_tolerance, "",
             "largest pressure jump left in contact, of the peak pressure")
      .Positive();
   keys.Auto("search_radius", options.search_radius, length,
             "how far the destination looks for the source; the destination's "
             "thickness");
   keys.Word<InitialOverlap>("initial_overlap", options.initial_overlap,
                             {{"press_out", InitialOverlap::press_out},
                              {"remove", InitialOverlap::remove}},
                             "what becomes of surfaces that overlap as meshed: "
                             "the first step presses it out, or gaps are "
                             "measured from it");
   keys.Auto("overlap_limit", options.overlap_limit, length,
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
   keys
      .Value(
         "quadrature_order", options.quadrature_order, "",
         "exactness of the quadrature on the part of a face that one face of "
         "the source covers; not 3")
      .From(1, 25);
   return keys;
}

KeyTable TimeKeys(TimeOptions &time)
{
   KeyTable keys;
   keys.Value("end", time.end, time_unit, "when the run ends")
      .Required()
      .Positive()
      .Named("the end time");
   keys.Value("step", time.step, time_unit, "length of the steps")
      .Required()
      .Positive()
      .Named("the time step");
   keys.Word<TimeScheme>("scheme", time.scheme, TimeSchemeWords(),
                         "how time is discretized");
   keys.Value("adaptive", time.adaptive, "",
              "whether the length of steps follows from the error");
   keys
      .Value("error_tolerance", time.error_tolerance, "",
             "error of an adaptive step in the energy norm, relative")
      .Inside(0.0, 1.0);
   keys.Value("cut_back", time.cut_back, "",
              "whether a step that fails is tried again with half the length");
   keys.Auto("min_step", time.min_step, time_unit,
             "length below which no step is cut; step / 1000");
   keys.Auto("max_step", time.max_step, time_unit,
             "longest adaptive step; end / 10, or step if that is longer");
   keys.Value("stops", time.stops, time_unit,
              "times at which a step shall end, besides the points of curves; "
              "they matter between 0 and the end");
   return keys;
}

KeyTable SolverKeys(NonlinearOptions &solver)
{
   LinearOptions &linear = solver.linear;
   KeyTable keys;
   keys.Word<LinearMethod>("linear", linear.method, LinearMethodWords(),
                           "how the linear systems are preconditioned");
   keys
      .Value("tolerance", linear.relative_tolerance, "",
             "relative accuracy of Newton's method, and so of the linear "
             "systems")
      .Formerly("linear_tolerance")
      .Inside(0.0, 0.1);
   keys
      .Value("max_linear", linear.max_iterations, "",
             "most iterations for a linear system")
      .From(1, 100000);
   keys
      .Value("direct_below", linear.direct_below, "",
             "for \"auto\": up to this many unknowns a factorization is kept; "
             "twice as many with stiff fibers")
      .AtLeast(0);
   keys.Word<DirectLibrary>(
      "direct", linear.direct.library, DirectLibraryWords(),
      "the library that factorizes; umfpack works on one rank");
   keys
      .Value("direct_memory_limit", linear.direct.memory_limit, "MB",
             "most memory for a factorization on a rank; 0: no limit")
      .From(0, 100000000);
   keys
      .Value("renew_after", linear.renew_after, "",
             "iterations lost to an old factorization until it is renewed")
      .From(1, 100000);
   keys
      .Value("max_newton", solver.max_newton, "",
             "most Newton iterations for one set of multipliers")
      .From(1, 1000);
   keys
      .Value("max_augmentations", solver.max_augmentations, "",
             "most augmentations in a step")
      .From(1, 1000);
   keys
      .Value("active_set_tolerance", solver.active_set_tolerance, "",
             "accuracy that suffices to find the active set; 0 solves every "
             "system to the end")
      .From(0.0, 0.1);
   keys.Table("tuning", TuningKeys(solver.tuning),
              "measured constants of the solvers");
   return keys;
}

KeyTable LineKeys(LineCase &line)
{
   KeyTable keys;
   keys.Value("name", line.line.name, "", "of the file").Required();
   keys.Value("from", line.line.from, length, "first point").Required();
   keys.Value("to", line.line.to, length, "last point").Required();
   keys.Value("points", line.line.points, "", "how many, both ends included")
      .From(2, most_points);
   keys.Value("region", line.line.regions, "",
              "where to look for the points; everywhere if left out");
   keys.Value("times", line.times, time_unit,
              "when it is sampled; at the end if left out");
   return keys;
}

KeyTable OutputKeys(OutputCase &output)
{
   KeyTable keys;
   keys.Value("directory", output.directory, "",
              "where the results go, relative to the working directory");
   keys
      .Value("fields_every", output.fields_every, "",
             "steps between fields for ParaView; 0: none")
      .AtLeast(0);
   keys
      .Value("checkpoint_every", output.checkpoint_every, "",
             "steps between checkpoints; 0: none but upon Ctrl-C")
      .AtLeast(0);
   keys.List<LineCase>("line", output.lines, LineKeys, "");
   return keys;
}
} // namespace

KeyTable CaseKeys(CaseFile &setup)
{
   KeyTable keys;
   keys.Value("title", setup.title, "", "says what the case is");
   keys.Table("mesh", MeshKeys(setup.mesh), "");
   keys.Table("space", SpaceKeys(setup.space), "");
   keys.Table("physics", PhysicsKeys(setup.space), "");
   keys
      .List<MaterialCase>("material", setup.materials, MaterialKeys,
                          "of all regions")
      .Required();
   keys.List<BoundaryCase>("boundary", setup.boundaries, BoundaryKeys, "");
   keys.List<RigidBodyCase>(
      "rigid_body", setup.rigid_bodies, RigidBodyKeys,
      "moves what is tied to it as one, by translations and rotations");
   keys.List<ContactCase>("contact", setup.contacts, ContactKeys, "");
   keys.Table("time", TimeKeys(setup.time), "");
   keys.Table("solver", SolverKeys(setup.solver), "");
   keys.Table("output", OutputKeys(setup.output), "");
   return keys;
}

} // namespace synovia
