#pragma once

#include "synovia/cases/case_reading.hpp"
#include "synovia/general/load_curve.hpp"
#include "synovia/io/line_sampler.hpp"
#include "synovia/io/log_definition.hpp"
#include "synovia/mesh/rigid_shape.hpp"
#include "synovia/physics/biphasic_problem.hpp"
#include "synovia/time/time_stepper.hpp"

#include <array>
#include <iosfwd>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace synovia
{

// What a case file says, as plain structs: a file fills them, or a program.
// Units are the case's own consistent set. `synovia --dry-schema` lists the
// keys that stand for the members.

/// What makes a mesh: the name of a script in meshes/, and its arguments. For
/// users and scripts/run; the library runs none.
struct MeshGenerator
{
   /// Empty: the mesh is made otherwise.
   std::string script;
   std::vector<std::string> arguments;
};

struct MeshCase
{
   /// In a file, relative to its directory.
   std::string file;
   ReadOptions options;
   MeshGenerator generator;
};

/// A fiber law by its name, for a distribution of fibers.
struct FiberCase
{
   std::string model = "fiber_exp_pow";
   std::map<std::string, mfem::real_t> parameters{};
};

/// A law of the drained solid by its name, with the values of its parameters by
/// theirs: see SolidLaws(), or `synovia --dry-schema`.
struct SolidCase
{
   std::string model = "isotropic";
   std::map<std::string, mfem::real_t> parameters{};
   /// What a mixture is made of.
   std::vector<SolidCase> solids{};
   std::map<std::string, std::array<mfem::real_t, 3>> vectors{};
   /// What a distribution of fibers is made of.
   FiberCase fibers{};
};

/// A law of the permeability likewise: see PermeabilityLaws().
struct PermeabilityCase
{
   /// The model of an elastic solid without fluid.
   static constexpr const char *none = "none";
   std::string model = "constant";
   std::map<std::string, mfem::real_t> parameters{};
};

enum class FrameType
{
   cartesian,
   cylindrical,
   /// Along a vector that the mesh file has for each element.
   field,
   /// Along surfaces.
   projected
};

/// The axes of an anisotropic material; members that don't go with the type
/// have no effect.
struct FrameCase
{
   FrameType type = FrameType::cartesian;
   /// Cartesian, cylindrical.
   std::array<mfem::real_t, 3> axis{{0.0, 0.0, 1.0}};
   /// Cylindrical: a point on the axis.
   std::array<mfem::real_t, 3> origin{{0.0, 0.0, 0.0}};
   /// Surfaces midway between whose centers the origin is instead.
   std::vector<std::string> between;
   /// Surfaces the origin is at the center of instead: of the circle that fits
   /// them best, seen along the axis.
   std::vector<std::string> around;
   /// Field: of the vectors in the mesh file.
   std::string name;
   /// Projected: what is projected, and the surfaces that it is projected on.
   std::array<mfem::real_t, 3> direction{{0.0, 0.0, 0.0}};
   std::vector<std::string> surfaces;

   bool HasOrigin() const;
};

enum class SupplyModel
{
   none,
   starling
};

/// Fluid that vessels let in.
struct SupplyCase
{
   SupplyModel model = SupplyModel::none;
   /// Without effect if there is none.
   FluidSupply starling;

   FluidSupply Supply() const
   {
      return model == SupplyModel::starling ? starling : FluidSupply();
   }
};

struct MaterialCase
{
   std::vector<std::string> regions;
   SolidCase solid;
   PermeabilityCase permeability;
   mfem::real_t solid_fraction = 0.2;
   bool mean_dilatation = false;
   /// True ones, for forces per mass (mass / length^3).
   mfem::real_t solid_density = 0.0;
   mfem::real_t fluid_density = 0.0;
   SupplyCase supply;
   FrameCase frame;

   bool HasFluid() const
   {
      return permeability.model != PermeabilityCase::none;
   }
};

/// Springs per area, between the surface and a fixed base.
struct SpringCase
{
   /// Of all springs together (force / length); 0: there are none.
   mfem::real_t stiffness = 0.0;
   /// Zero: alike in all directions.
   std::array<mfem::real_t, 3> direction{{0.0, 0.0, 0.0}};

   bool IsDirected() const;
   /// Whether they resist a component of the displacement.
   bool Holds(int component) const;
};

/// A rigidly moving surface, driven by its resultant.
struct ForceCase
{
   std::array<mfem::real_t, 3> direction{{0.0, 0.0, 0.0}};
   std::optional<LoadCurve> curve;

   bool IsDirected() const;
   /// Whether it drives a component of the displacement.
   bool Drives(int component) const;
};

struct BoundaryCase
{
   /// By which steps change or release it; may be empty.
   std::string name{};
   std::vector<std::string> surfaces;
   /// Whether the displacement counts from what it is when the step begins that
   /// prescribes it; without effect outside of steps.
   bool relative = false;
   /// When that step begins, as CasesOfSteps() has it.
   mfem::real_t begin = 0.0;
   /// By component (length); none: free.
   std::array<std::optional<LoadCurve>, 3> displacement;
   /// Fluid pressure (stress).
   std::optional<LoadCurve> pressure;
   /// Total traction by component (stress).
   std::optional<std::array<LoadCurve, 3>> traction;
   /// Total traction along the outward normal, positive in tension (stress).
   std::optional<LoadCurve> normal_traction;
   /// Traction along the outward normal of the solid alone, to which the
   /// fluid's pressure adds (stress).
   std::optional<LoadCurve> effective_traction;
   /// Whether no fluid passes even if it is a contact surface that nothing
   /// touches.
   bool sealed = false;
   /// Outward relative flux (length / time).
   std::optional<LoadCurve> normal_flux;
   /// Outward flux of fluid and solid together (length / time).
   std::optional<LoadCurve> mixture_flux;
   SpringCase spring;
   /// The direction across a plane that the surfaces slide along; any length.
   std::optional<std::array<mfem::real_t, 3>> guide;
   ForceCase force;

   /// Whether a displacement, springs or a guide resist motion along that axis.
   bool Holds(int component) const;
};

/// A rigid body: surfaces that are tied to it, regions that are part of it, or
/// a shape without a mesh. Freedoms are those along and about the axes of
/// space.
struct RigidBodyCase
{
   std::string name;
   std::vector<std::string> surfaces;
   std::vector<std::string> regions;
   /// Its name has no effect; see Shape().
   RigidShape shape;
   /// Center of moments and of the translation; none: that of the shape, or the
   /// surfaces' center of area.
   std::optional<std::array<mfem::real_t, 3>> reference;
   /// As BoundaryCase has them.
   bool relative = false;
   mfem::real_t begin = 0.0;
   /// Prescribed, by component (length, rad); none: free.
   std::array<std::optional<LoadCurve>, 3> translation;
   std::array<std::optional<LoadCurve>, 3> rotation;
   /// On free components (force, force x length).
   std::optional<std::array<LoadCurve, 3>> force;
   std::optional<std::array<LoadCurve, 3>> moment;
   /// Whether force and moment turn with the body.
   bool load_follows = false;
   /// Of springs on free components (force / length, force x length / rad).
   std::array<mfem::real_t, 3> stiffness{{0.0, 0.0, 0.0}};
   std::array<mfem::real_t, 3> rotational_stiffness{{0.0, 0.0, 0.0}};

   RigidBodyOptions Options() const;
   /// The shape with the body's name, if it has one.
   std::optional<RigidShape> Shape() const;
   /// The regions, and that of the shape.
   std::vector<std::string> AllRegions() const;
};

struct ContactCase
{
   /// Of the pair in the output; if empty, made of the first source and the
   /// first destination.
   std::string name;
   std::vector<std::string> source;
   std::vector<std::string> destination;
   ContactOptions options;

   std::string Name() const;
};

/// Surfaces that are glued.
struct TieCase
{
   /// In the output; if empty, made of the first source and the first
   /// destination.
   std::string name;
   std::vector<std::string> source;
   std::vector<std::string> destination;
   TieOptions options;

   std::string Name() const;
};

/// A part of a run. What it prescribes holds until a later step prescribes it
/// otherwise or releases it; times of its curves count from its beginning.
struct StepCase
{
   std::string name;
   mfem::real_t duration = 0.0;
   /// Time step settings; 0 or none: the case's.
   mfem::real_t step = 0.0;
   mfem::real_t growth = 0.0;
   std::optional<bool> adaptive{};
   mfem::real_t min_step = 0.0;
   mfem::real_t max_step = 0.0;
   /// Names of boundaries, ligaments, contact pairs and ties that end when it
   /// begins.
   std::vector<std::string> release{};
   /// Each replaces the entry of the same name as a whole; without surfaces it
   /// keeps the surfaces of that entry.
   std::vector<BoundaryCase> boundaries{};
   /// Of existing bodies.
   std::vector<RigidBodyCase> rigid_bodies{};
   std::vector<ContactCase> contacts{};
};

struct LineCase
{
   LineDefinition line;
   /// When it is sampled; empty: at the end.
   std::vector<mfem::real_t> times;
};

struct OutputCase
{
   std::string directory = "out";
   /// Steps from one to the next; 0: never, and no fields of the end either.
   int fields_every = 1;
   /// Likewise; one is written upon SIGINT and SIGTERM in any case.
   int checkpoint_every = 10;
   std::vector<LineCase> lines;
   std::vector<LogDefinition> logs;
};

struct CaseFile
{
   std::string title;
   MeshCase mesh;
   SpaceOptions space;
   /// Force per mass, by component (length / time^2).
   std::optional<std::array<LoadCurve, 3>> acceleration;
   std::vector<MaterialCase> materials;
   std::vector<BoundaryCase> boundaries;
   std::vector<RigidBodyCase> rigid_bodies;
   std::vector<Ligament> ligaments;
   std::vector<Joint> joints;
   std::vector<ContactCase> contacts;
   std::vector<TieCase> ties;
   /// If there are steps, it ends with the last one.
   TimeOptions time;
   std::vector<StepCase> steps;
   NonlinearOptions solver;
   OutputCase output;

   /// Where the keys were written, for messages; empty if a program did it.
   CasePlaces places;
};

/// Reads a case from TOML and applies @a overrides, each key.path=value, in
/// order. @a source names the text in messages, and its directory is where a
/// relative mesh file is looked for. Throws Error that lists what is wrong:
/// what isn't TOML, unknown keys, wrong types, numbers out of range, what is
/// missing, and contradictions within the case.
CaseFile ParseCase(const std::string &text, const std::string &source,
                   const std::vector<std::string> &overrides = {});

/// The same for a file. Collective: rank 0 reads, and all ranks throw alike.
CaseFile ReadCase(const std::string &file, MPI_Comm comm,
                  const std::vector<std::string> &overrides = {});

/// Throws Error, as ParseCase() does, if the numbers of a case are out of range
/// or the case contradicts itself: for one that a program made.
void CheckCase(const CaseFile &setup);

/// Writes the case as TOML that reads back the same, with all defaults.
void WriteCase(const CaseFile &setup, std::ostream &out);

/// Lists every key of a case file with its type, default, unit and meaning.
void ListCaseKeys(std::ostream &out);

} // namespace synovia
