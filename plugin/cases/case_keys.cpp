#include "synovia/cases/case_keys.hpp"
#include "synovia/cases/condition_keys.hpp"
#include "synovia/cases/connection_keys.hpp"
#include "synovia/cases/key_names.hpp"
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

KeyTable PhysicsKeys(CaseFile &setup)
{
   KeyTable keys;
   keys.Word<Deformation>("deformation", setup.space.deformation,
                          DeformationWords(),
                          "of all bodies; it says which laws there are");
   keys.Value("acceleration", setup.acceleration, "length/time^2",
              "force per mass on all that has densities, such as gravity, by "
              "component");
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
      keys.Value("origin", frame.origin, quantities::length,
                 "point on the axis");
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

KeyTable StarlingKeys(FluidSupply &supply)
{
   KeyTable keys;
   keys
      .Value("kp", supply.kp, "1/(stress time)",
             "conductance of the vessels' walls in a volume")
      .Required()
      .AtLeast(0.0);
   keys.Value("pc", supply.pc, quantities::stress,
              "pressure in the vessels: kp (pc - p) enters a volume, as it is "
              "deformed");
   return keys;
}

KeyTable SupplyKeys(SupplyCase &supply)
{
   KeyTable keys;
   keys.Choice<SupplyModel>(
      "model", supply.model,
      {{"none", SupplyModel::none}, {"starling", SupplyModel::starling}},
      {"no fluid but that of surfaces", "vessels with a pressure of their own"},
      [&supply](SupplyModel model)
      {
         return model == SupplyModel::starling ? StarlingKeys(supply.starling)
                                               : KeyTable();
      },
      "what lets fluid in everywhere, one of:");
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
   keys
      .Value("solid_density", material.solid_density, "mass/length^3",
             "of the solid by itself, for physics.acceleration")
      .AtLeast(0.0);
   keys
      .Value("fluid_density", material.fluid_density, "mass/length^3",
             "of the fluid by itself, likewise")
      .AtLeast(0.0);
   keys.Value("mean_dilatation", material.mean_dilatation, "",
              "whether the solid sees each element's mean change of volume: "
              "with order 1, hexahedra and wedges of a nearly incompressible "
              "solid (nu above 0.4) are too stiff without");
   keys.Table("supply", SupplyKeys(material.supply), "");
   keys.Table("frame", FrameKeys(material.frame),
              "axes r, theta, z of fibers, of the undeformed body");
   return keys;
}

KeyTable TimeKeys(TimeOptions &time, bool has_steps)
{
   KeyTable keys;
   CaseKey &end = keys.Value("end", time.end, quantities::time,
                             "when the run ends; with steps, when they do");
   end.Positive().Named("the end time");
   end.required = !has_steps;
   keys.Value("step", time.step, quantities::time, "length of the steps")
      .Required()
      .Positive()
      .Named("the time step");
   keys.Value("growth", time.growth, "",
              "how much longer each step is than the one before it, 1 or more; "
              "from step anew after each point of a load curve");
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
   keys.Auto("min_step", time.min_step, quantities::time,
             "length below which no step is cut; step / 1000");
   keys.Auto("max_step", time.max_step, quantities::time,
             "longest step that is adaptive or has grown; end / 10, or step if "
             "that is longer");
   keys.Value("stops", time.stops, quantities::time,
              "times at which a step shall end, besides the points of curves; "
              "they matter between 0 and the end");
   return keys;
}

KeyTable StepKeys(StepCase &step)
{
   KeyTable keys;
   keys.Value("name", step.name, "", "of the step in log and checkpoints")
      .Required();
   keys.Value("duration", step.duration, quantities::time, "how long it lasts")
      .Required()
      .Positive()
      .Named("the duration");
   keys.Auto("step", step.step, quantities::time,
             "length of its time steps; as time.step");
   keys.Auto("growth", step.growth, "",
             "how much longer each is than the one before it; as time.growth");
   keys.Value("adaptive", step.adaptive, "",
              "whether their length follows from the error; as time.adaptive "
              "if left out");
   keys.Auto("min_step", step.min_step, quantities::time,
             "length below which none is cut; as time.min_step, or a "
             "thousandth of its own step");
   keys.Auto("max_step", step.max_step, quantities::time,
             "longest one that is adaptive or has grown; a tenth of the "
             "duration, or step if that is longer");
   keys.Value(
      "release", step.release, "",
      "names of boundaries, ligaments, contact pairs and ties that end when it "
      "begins");
   keys.List<BoundaryCase>("boundary", step.boundaries, StepBoundaryKeys,
                           "from this step on; times count from its beginning");
   keys.List<RigidBodyCase>("rigid_body", step.rigid_bodies, StepRigidBodyKeys,
                            "how bodies move from this step on");
   keys.List<ContactCase>("contact", step.contacts, ContactKeys,
                          "from this step on");
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
             "for \"auto\": up to this many unknowns a factorization is kept")
      .AtLeast(0);
   keys
      .Value("direct_below_with_fibers", linear.direct_below_with_fibers, "",
             "the same where bodies have fibers")
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
             "most Newton iterations for one set of multipliers, in finite "
             "deformation for one search of contact")
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
   keys.Value("from", line.line.from, quantities::length, "first point")
      .Required();
   keys.Value("to", line.line.to, quantities::length, "last point").Required();
   keys.Value("points", line.line.points, "", "how many, both ends included")
      .From(2, most_points);
   keys.Value("region", line.line.regions, "",
              "where to look for the points; everywhere if left out");
   keys.Value("times", line.times, quantities::time,
              "when it is sampled; at the end if left out");
   return keys;
}

KeyTable LogKeysOf(LogSubject of, LogDefinition &log)
{
   KeyTable keys;
   if (of == LogSubject::rigid_bodies)
   {
      keys.Value("rigid_bodies", log.rigid_bodies, "",
                 "which, by name; all if left out");
      return keys;
   }
   keys.Value("numbers", log.numbers, "",
              "which, by their numbers in the mesh file; all if left out");
   keys.Value("regions", log.regions, "", "only those of these regions");
   if (of == LogSubject::nodes)
   {
      keys.Value("surfaces", log.surfaces, "", "only those of these surfaces");
   }
   return keys;
}

std::string DataText(LogSubject of)
{
   std::string text = "a row for each:";
   for (const std::string &name : LogData(of))
   {
      text += " " + name;
   }
   return text;
}

KeyTable LogKeys(LogDefinition &log)
{
   KeyTable keys;
   keys.Value("file", log.file, "", "its name, in logs/").Required();
   keys.Value("data", log.data, "", "columns, in order").Required();
   keys.Value("delimiter", log.delimiter, "", "between columns");
   keys.Choice<LogSubject>(
      "of", log.of, LogSubjectWords(),
      {DataText(LogSubject::nodes), DataText(LogSubject::elements),
       DataText(LogSubject::rigid_bodies)},
      [&log](LogSubject of) { return LogKeysOf(of, log); },
      "what the table is of, one of:");
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
   keys.List<LogDefinition>("log", output.logs, LogKeys,
                            "tables of each step, as FEBio's log file has");
   return keys;
}
} // namespace

KeyTable CaseKeys(CaseFile &setup)
{
   KeyTable keys;
   keys.Value("title", setup.title, "", "says what the case is");
   keys.Table("mesh", MeshKeys(setup.mesh), "");
   keys.Table("space", SpaceKeys(setup.space), "");
   keys.Table("physics", PhysicsKeys(setup), "");
   keys
      .List<MaterialCase>("material", setup.materials, MaterialKeys,
                          "of all regions")
      .Required();
   keys.List<BoundaryCase>("boundary", setup.boundaries, BoundaryKeys, "");
   keys.List<RigidBodyCase>(
      "rigid_body", setup.rigid_bodies, RigidBodyKeys,
      "moves what is tied to it as one, by translations and rotations");
   keys.List<Ligament>("ligament", setup.ligaments, LigamentKeys,
                       "joins rigid bodies, point to point");
   keys.List<Joint>("joint", setup.joints, JointKeys,
                    "reports how two rigid bodies are placed beside each "
                    "other, and prescribes it");
   keys.List<ContactCase>("contact", setup.contacts, ContactKeys, "");
   keys.List<TieCase>("tie", setup.ties, TieKeys,
                      "glues surfaces of bodies whose meshes don't match: "
                      "displacement and fluid pressure are continuous");
   keys.Table("time", TimeKeys(setup.time, !setup.steps.empty()), "");
   keys.List<StepCase>("step", setup.steps, StepKeys,
                       "parts of the run, one after the other");
   keys.Table("solver", SolverKeys(setup.solver), "");
   keys.Table("output", OutputKeys(setup.output), "");
   return keys;
}

} // namespace synovia
