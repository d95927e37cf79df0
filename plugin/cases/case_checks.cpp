#include "synovia/cases/case_checks.hpp"
#include "synovia/cases/case_words.hpp"
#include "synovia/cases/connection_checks.hpp"
#include "synovia/cases/key_names.hpp"
#include "synovia/cases/law_checks.hpp"
#include "synovia/cases/name_checks.hpp"
#include "synovia/cases/step_checks.hpp"
#include "synovia/general/text.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace synovia
{

using namespace mfem;

namespace
{
// The position of an axis must be given once.
void CheckAxis(const FrameCase &frame, const std::string &path,
               CaseReading &reading)
{
   const auto check = [&](const std::vector<std::string> &surfaces,
                          const std::string &key, bool also)
   {
      if (!surfaces.empty())
      {
         CheckNames(surfaces, path + key, "surface", reading);
         reading.Require(!also && !frame.HasOrigin(), path + key,
                         "the axis is said to be somewhere else too; give one "
                         "of origin, between, around");
      }
   };
   check(frame.between, ".between", false);
   check(frame.around, ".around", !frame.between.empty());
}

void CheckFrame(const FrameCase &frame, const std::string &path,
                CaseReading &reading)
{
   switch (frame.type)
   {
   case FrameType::cylindrical:
      CheckAxis(frame, path, reading);
      break;
   case FrameType::field:
      reading.Require(!frame.name.empty(), path + ".name", "the name is empty");
      break;
   case FrameType::projected:
      CheckNames(frame.surfaces, path + ".surfaces", "surface", reading);
      break;
   default:
      break;
   }
}

void CheckMaterials(const CaseFile &setup, CaseReading &reading)
{
   reading.Require(!setup.materials.empty(), "material",
                   "there is no material; every region needs one");
   Once once(reading);
   for (size_t i = 0; i < setup.materials.size(); i++)
   {
      const MaterialCase &material = setup.materials[i];
      const std::string path = EntryPath("material", i, "regions");
      CheckNames(material.regions, path, "region", reading);
      CheckFrame(material.frame, EntryPath("material", i, "frame"), reading);
      CheckLaws(material, EntryPath("material", i), setup.space.deformation,
                reading);
      reading.Require(!material.mean_dilatation || setup.space.order == 1,
                      EntryPath("material", i, "mean_dilatation"),
                      "this is for displacements of order 1; those of order " +
                         std::to_string(setup.space.order) + " don't need it");
      for (const std::string &region : Distinct(material.regions))
      {
         once.Enter(region, path,
                    "the region " + Quoted(region) + " has a material already");
      }
   }
}

// Enters the conditions on a surface, of which some exclude each other.
void EnterConditions(const BoundaryCase &boundary, const std::string &surface,
                     const std::string &path, Once &once)
{
   const auto enter =
      [&](bool given, const std::string &key, const std::string &what)
   {
      if (given)
      {
         once.Enter(surface + '\n' + what, path + "." + key,
                    what + " on " + Quoted(surface) + " is prescribed already");
      }
   };
   constexpr const char *axes[3] = {"x", "y", "z"};
   for (int d = 0; d < 3; d++)
   {
      // A load on a prescribed displacement would have no effect.
      const std::string along =
         std::string("displacement, traction or force along ") + axes[d];
      enter(boundary.displacement[d].has_value(), "displacement", along);
      enter(boundary.traction && !(*boundary.traction)[d].IsZero(), "traction",
            along);
      enter(boundary.force.Drives(d), "force", along);
   }
   enter(boundary.pressure.has_value(), "pressure", "pressure or flux");
   enter(boundary.sealed, "sealed", "pressure or flux");
   enter(boundary.normal_flux.has_value(), "normal_flux", "pressure or flux");
   enter(boundary.mixture_flux.has_value(), "mixture_flux", "pressure or flux");
   enter(boundary.normal_traction.has_value(), "normal_traction",
         "the normal traction");
   enter(boundary.effective_traction.has_value(), "effective_traction",
         "the normal traction");
}

void CheckBoundary(const BoundaryCase &boundary, const std::string &path,
                   Once &once, CaseReading &reading)
{
   CheckNames(boundary.surfaces, path + ".surfaces", "surface", reading);
   const auto &u = boundary.displacement;
   const ForceCase &force = boundary.force;
   const bool stiff = boundary.spring.stiffness > 0.0;
   const bool moved =
      u[0] || u[1] || u[2] || force.curve || stiff || boundary.guide;
   const std::vector<std::string> keys = {"displacement",
                                          "pressure",
                                          "traction",
                                          "normal_traction",
                                          "effective_traction",
                                          "sealed",
                                          "normal_flux",
                                          "mixture_flux",
                                          "spring",
                                          "guide",
                                          "force"};
   // Keys with errors count.
   const bool written =
      std::any_of(keys.begin(), keys.end(),
                  [&](const std::string &key)
                  { return reading.Places().count(path + "." + key) > 0; });
   reading.Require(
      moved || boundary.pressure || boundary.traction ||
         boundary.normal_traction || boundary.effective_traction ||
         boundary.sealed || boundary.normal_flux || boundary.mixture_flux ||
         written,
      path, "nothing is prescribed here; give one of " + JoinedNames(keys));
   reading.Require(!boundary.relative || u[0] || u[1] || u[2],
                   path + ".relative", "no displacement is prescribed here");
   reading.Require(!boundary.guide || Length(*boundary.guide) > 0.0,
                   path + ".guide", "the direction is zero");
   reading.Require(stiff || !boundary.spring.IsDirected(), path + ".spring",
                   "there is a direction, but no stiffness");
   reading.Require(force.curve || !force.IsDirected(), path + ".force",
                   "there is a direction, but no curve");
   reading.Require(!force.curve || force.IsDirected(), path + ".force",
                   "there is a curve, but no direction");
   for (const std::string &surface : Distinct(boundary.surfaces))
   {
      EnterConditions(boundary, surface, path, once);
      if (moved && surface.find_first_of(",\"'/\\") != std::string::npos)
      {
         reading.AddError(path + ".surfaces",
                          "the name " + Quoted(surface) +
                             " cannot be a column of the history, for it has "
                             "a comma, a quote or a slash; rename the physical "
                             "surface");
      }
   }
}

void CheckBoundaries(const CaseFile &setup, CaseReading &reading)
{
   Once once(reading);
   for (size_t i = 0; i < setup.boundaries.size(); i++)
   {
      CheckBoundary(setup.boundaries[i], EntryPath("boundary", i), once,
                    reading);
      reading.Require(!setup.boundaries[i].effective_traction ||
                         setup.space.deformation == Deformation::finite,
                      EntryPath("boundary", i, "effective_traction"),
                      "it is only known in finite deformation; give the total "
                      "traction");
      reading.Require(!setup.boundaries[i].mixture_flux ||
                         setup.space.deformation == Deformation::finite,
                      EntryPath("boundary", i, "mixture_flux"),
                      "it is only known in finite deformation; give the "
                      "relative flux");
   }
}

// What moves a surface by itself; empty if nothing does.
std::string MovingKey(const BoundaryCase &boundary)
{
   const auto &u = boundary.displacement;
   return u[0] || u[1] || u[2]   ? "displacement"
          : boundary.force.curve ? "force"
                                 : "";
}

void CheckRigidBodies(const CaseFile &setup, CaseReading &reading)
{
   Once names(reading);
   Once surfaces(reading);
   std::set<std::string> moved;
   for (size_t i = 0; i < setup.boundaries.size(); i++)
   {
      const BoundaryCase &boundary = setup.boundaries[i];
      const std::string key = MovingKey(boundary);
      for (const std::string &surface : Distinct(boundary.surfaces))
      {
         // Several boundaries may move one surface, each along another axis.
         if (!key.empty() && moved.insert(surface).second)
         {
            surfaces.Enter(surface, EntryPath("boundary", i, key), "");
         }
      }
   }
   for (size_t i = 0; i < setup.rigid_bodies.size(); i++)
   {
      const RigidBodyCase &body = setup.rigid_bodies[i];
      const std::string path = EntryPath("rigid_body", i);
      // Regions and a shape do without.
      if (!body.surfaces.empty() || body.AllRegions().empty())
      {
         CheckNames(body.surfaces, path + ".surfaces", "surface", reading);
      }
      if (!body.regions.empty())
      {
         CheckNames(body.regions, path + ".regions", "region", reading);
      }
      reading.Require(!body.name.empty() || reading.HasError(path + ".name"),
                      path + ".name", "the name is empty");
      if (!body.name.empty())
      {
         names.Enter(body.name, path + ".name",
                     "a rigid body is called " + Quoted(body.name) +
                        " already; give this one another name");
         CheckFileName(body.name, path + ".name", reading);
      }
      for (const std::string &surface : Distinct(body.surfaces))
      {
         surfaces.Enter(surface, path + ".surfaces",
                        Quoted(surface) +
                           " is moved already; tie it to one rigid body, or "
                           "prescribe its displacement or force");
      }
      const RigidBodyOptions options = body.Options();
      reading.Require(
         !body.relative ||
            std::any_of(options.prescribed.begin(), options.prescribed.end(),
                        [](const auto &curve) { return curve.has_value(); }),
         path + ".relative", "no freedom is prescribed here");
      const std::string problem =
         Contradiction(options, setup.space.deformation);
      reading.Require(problem.empty(), path, problem);
   }
}

// Paths of the keys that prescribe pressure or flux, by surface.
std::map<std::string, std::string> FluidConditions(const CaseFile &setup)
{
   std::map<std::string, std::string> paths;
   for (size_t i = 0; i < setup.boundaries.size(); i++)
   {
      const BoundaryCase &boundary = setup.boundaries[i];
      if (boundary.pressure || boundary.normal_flux || boundary.mixture_flux)
      {
         for (const std::string &surface : boundary.surfaces)
         {
            paths[surface] = EntryPath("boundary", i,
                                       boundary.pressure      ? "pressure"
                                       : boundary.normal_flux ? "normal_flux"
                                                              : "mixture_flux");
         }
      }
   }
   return paths;
}

void CheckContacts(const CaseFile &setup, CaseReading &reading)
{
   Once names(reading);
   Once pairs(reading);
   std::map<std::string, std::string> fluid = FluidConditions(setup);
   for (size_t i = 0; i < setup.contacts.size(); i++)
   {
      const ContactCase &contact = setup.contacts[i];
      const std::string path = EntryPath("contact", i);
      CheckNames(contact.source, path + ".source", "surface", reading);
      CheckNames(contact.destination, path + ".destination", "surface",
                 reading);
      const std::set<std::string> source = Distinct(contact.source);
      for (const std::string &surface : contact.destination)
      {
         if (source.count(surface))
         {
            reading.AddError(path + ".destination",
                             Quoted(surface) + " is in the source too; a "
                                               "surface can't touch itself");
         }
      }
      for (const auto *side : {&contact.source, &contact.destination})
      {
         for (const std::string &surface : *side)
         {
            const auto found = fluid.find(surface);
            if (found != fluid.end())
            {
               reading.AddError(found->second,
                                "the fluid on " + Quoted(surface) +
                                   " is the contact pair's: sealed where it "
                                   "touches, free to drain elsewhere (" +
                                   WhereIs(reading.Places(), path) + ")");
               fluid.erase(found);
            }
         }
      }
      if (!contact.source.empty() && !contact.destination.empty())
      {
         const std::string name = contact.Name();
         names.Enter(name, path,
                     "a contact pair is called " + Quoted(name) +
                        " already; give this one another name");
         CheckFileName(name, path + ".name", reading);
      }
      for (const std::string &a : source)
      {
         for (const std::string &b : contact.destination)
         {
            pairs.Enter(std::min(a, b) + '\n' + std::max(a, b), path,
                        Quoted(a) + " and " + Quoted(b) +
                           " are in a contact pair already");
         }
      }
      reading.Require(contact.options.quadrature_order != 3,
                      path + ".quadrature_order",
                      "found 3, which has negative weights; take 4");
      reading.Require(contact.options.friction.coefficient == 0.0 ||
                         setup.space.deformation == Deformation::finite,
                      path + ".friction",
                      "there is friction in finite deformation only; set "
                      "physics.deformation = \"finite\", or leave it out");
   }
}

// Paths of the contact pairs, by surface.
std::map<std::string, std::string> TouchingSurfaces(const CaseFile &setup)
{
   std::map<std::string, std::string> paths;
   for (size_t i = 0; i < setup.contacts.size(); i++)
   {
      for (const auto *side :
           {&setup.contacts[i].source, &setup.contacts[i].destination})
      {
         for (const std::string &surface : *side)
         {
            paths[surface] = EntryPath("contact", i);
         }
      }
   }
   return paths;
}

void CheckTies(const CaseFile &setup, CaseReading &reading)
{
   Once names(reading);
   Once tied(reading);
   const std::map<std::string, std::string> touching = TouchingSurfaces(setup);
   for (size_t i = 0; i < setup.ties.size(); i++)
   {
      const TieCase &tie = setup.ties[i];
      const std::string path = EntryPath("tie", i);
      for (const auto &[side, key] :
           {std::pair(&tie.source, ".source"),
            std::pair(&tie.destination, ".destination")})
      {
         CheckNames(*side, path + key, "surface", reading);
         for (const std::string &surface : Distinct(*side))
         {
            tied.Enter(surface, path + key,
                       Quoted(surface) +
                          " is tied already; list all surfaces that it is "
                          "tied to on the other side of that tie");
            const auto found = touching.find(surface);
            reading.Require(
               found == touching.end(), path + key,
               Quoted(surface) +
                  " is in a contact pair as well; a surface is "
                  "tied or may touch" +
                  (found == touching.end()
                      ? ""
                      : " (" + WhereIs(reading.Places(), found->second) + ")"));
         }
      }
      if (!tie.source.empty() && !tie.destination.empty())
      {
         names.Enter(tie.Name(), path,
                     "a tie is called " + Quoted(tie.Name()) +
                        " already; give this one another name");
         CheckFileName(tie.Name(), path + ".name", reading);
      }
   }
}

void CheckBoundaryNames(const CaseFile &setup, CaseReading &reading)
{
   Once names(reading);
   for (size_t i = 0; i < setup.boundaries.size(); i++)
   {
      const std::string &name = setup.boundaries[i].name;
      if (!name.empty())
      {
         names.Enter(name, EntryPath("boundary", i, "name"),
                     "a boundary is called " + Quoted(name) + " already");
      }
   }
}

void CheckOutput(const CaseFile &setup, CaseReading &reading)
{
   reading.Require(!setup.output.directory.empty(), "output.directory",
                   "the name is empty");
   Once names(reading);
   for (size_t i = 0; i < setup.output.lines.size(); i++)
   {
      const LineCase &line = setup.output.lines[i];
      const std::string path = EntryPath("output.line", i);
      const std::string &name = line.line.name;
      reading.Require(!name.empty(), path + ".name", "the name is empty");
      if (!name.empty())
      {
         names.Enter(name, path + ".name",
                     "a line is called " + Quoted(name) + " already");
         CheckFileName(name, path + ".name", reading);
      }
      reading.Require(line.line.from != line.line.to ||
                         reading.HasError(path + ".from") ||
                         reading.HasError(path + ".to"),
                      path, "the line has no length");
      for (size_t k = 0; k < line.times.size(); k++)
      {
         reading.Require(line.times[k] > 0.0, EntryPath(path + ".times", k),
                         "found " + ToText(line.times[k]) +
                            "; it must be positive");
      }
   }
}

void CheckLogs(const CaseFile &setup, CaseReading &reading)
{
   Once names(reading);
   for (size_t i = 0; i < setup.output.logs.size(); i++)
   {
      const LogDefinition &log = setup.output.logs[i];
      const std::string path = EntryPath("output.log", i);
      reading.Require(!log.file.empty(), path + ".file", "the name is empty");
      if (!log.file.empty())
      {
         names.Enter(log.file, path + ".file",
                     "a log is called " + Quoted(log.file) + " already");
         CheckFileName(log.file, path + ".file", reading);
      }
      reading.Require(!log.data.empty() || reading.HasError(path + ".data"),
                      path + ".data", "there are no columns");
      const std::vector<std::string> &known = LogData(log.of);
      for (size_t k = 0; k < log.data.size(); k++)
      {
         reading.Require(std::find(known.begin(), known.end(), log.data[k]) !=
                            known.end(),
                         EntryPath(path + ".data", k),
                         "there is no " + Quoted(log.data[k]) + "; " +
                            WordFor(log.of, LogSubjectWords()) + " have " +
                            JoinedNames(known));
      }
      reading.Require(
         !log.delimiter.empty() && log.delimiter.find_first_of(
                                      "0123456789.+-en\n") == std::string::npos,
         path + ".delimiter",
         "columns can't be told apart by " + Quoted(log.delimiter));
      for (size_t k = 0; k < log.rigid_bodies.size(); k++)
      {
         reading.Require(
            std::any_of(setup.rigid_bodies.begin(), setup.rigid_bodies.end(),
                        [&](const RigidBodyCase &body)
                        { return body.name == log.rigid_bodies[k]; }),
            EntryPath(path + ".rigid_bodies", k),
            "there is no rigid body " + Quoted(log.rigid_bodies[k]));
      }
      reading.Require(log.of != LogSubject::rigid_bodies ||
                         !setup.rigid_bodies.empty(),
                      path + ".of", "there are no rigid bodies");
      reading.Require(log.of == LogSubject::rigid_bodies ||
                         setup.mesh.options.refine == 0,
                      path + ".of",
                      "nodes and elements of a refined mesh have no numbers; "
                      "take out mesh.refine");
   }
}

void CheckMesh(const MeshCase &mesh, CaseReading &reading)
{
   reading.Require(!mesh.file.empty(), "mesh.file", "the name is empty");
   // A case runs no programs from elsewhere.
   reading.Require(mesh.generator.script.find_first_of("/\\ ") ==
                      std::string::npos,
                   "mesh.generator",
                   "found " + Quoted(mesh.generator.script) +
                      "; the first string must be the name of a script in "
                      "meshes/, without a path, and arguments are strings of "
                      "their own");
}
} // namespace

namespace
{
void CheckAcceleration(const CaseFile &setup, CaseReading &reading)
{
   const bool heavy = std::any_of(
      setup.materials.begin(), setup.materials.end(),
      [](const MaterialCase &material)
      { return material.solid_density > 0.0 || material.fluid_density > 0.0; });
   reading.Require(!setup.acceleration || heavy, "physics.acceleration",
                   "no material has a density; give solid_density, "
                   "fluid_density or both");
}
} // namespace

void CheckConditions(const CaseFile &setup, CaseReading &reading)
{
   CheckAcceleration(setup, reading);
   CheckBoundaries(setup, reading);
   CheckRigidBodies(setup, reading);
   CheckContacts(setup, reading);
   CheckTies(setup, reading);
}

void CheckConsistency(const CaseFile &setup, CaseReading &reading)
{
   CheckMesh(setup.mesh, reading);
   CheckMaterials(setup, reading);
   CheckBoundaryNames(setup, reading);
   CheckConditions(setup, reading);
   CheckConnections(setup, reading);
   CheckStepLengths(setup.steps.empty() ? setup.time.end : 0.0, "end time",
                    setup.time, "time", reading);
   CheckSteps(setup, reading);
   CheckOutput(setup, reading);
   CheckLogs(setup, reading);
}

} // namespace synovia
