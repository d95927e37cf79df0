#include "synovia/cases/case_checks.hpp"
#include "synovia/cases/key_names.hpp"
#include "synovia/cases/law_checks.hpp"
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
// More steps than anybody waits for: a slip of the pen in step or end.
constexpr real_t most_steps = 1e7;
// Names of pairs and lines become parts of file names.
constexpr size_t longest_name = 100;

std::string Path(const std::string &list, size_t i, const std::string &key = "")
{
   return list + "." + std::to_string(i) + (key.empty() ? "" : "." + key);
}

/// Complains about the second of two entries with the same name, once for each
/// path.
class Once
{
public:
   explicit Once(CaseReading &reading_) : reading(reading_) {}

   void Enter(const std::string &name, const std::string &path,
              const std::string &problem)
   {
      const auto [first, fresh] = paths.emplace(name, path);
      if (!fresh && !reading.HasError(path))
      {
         reading.AddError(path, problem + " (" +
                                   WhereIs(reading.Places(), first->second) +
                                   ")");
      }
   }

private:
   CaseReading &reading;
   std::map<std::string, std::string> paths;
};

void CheckNames(const std::vector<std::string> &names, const std::string &path,
                const std::string &kind, CaseReading &reading)
{
   if (names.empty() && !reading.HasError(path))
   {
      reading.AddError(path, "no " + kind + " is named; name at least one");
   }
   std::set<std::string> seen;
   for (size_t i = 0; i < names.size(); i++)
   {
      if (names[i].empty())
      {
         reading.AddError(Path(path, i), "the name is empty");
      }
      else if (!seen.insert(names[i]).second)
      {
         reading.AddError(Path(path, i), Quoted(names[i]) + " is named twice");
      }
   }
}

// For what becomes a part of file names and of the history's columns.
void CheckFileName(const std::string &name, const std::string &path,
                   CaseReading &reading)
{
   if (name.find_first_of("/\\,\"'") != std::string::npos || name[0] == '.' ||
       name.size() > longest_name)
   {
      reading.AddError(path, "found the name " + Quoted(name) +
                                "; it must have at most " +
                                std::to_string(longest_name) +
                                " letters, no slash, comma or quote, and no "
                                "dot in front");
   }
}

// Where the axis of a frame is must be said once, and of a cylindrical one.
void CheckFrame(const FrameCase &frame, const std::string &path,
                CaseReading &reading)
{
   const auto check = [&](const std::vector<std::string> &surfaces,
                          const std::string &key, bool also)
   {
      if (surfaces.empty())
      {
         return;
      }
      CheckNames(surfaces, path + "." + key, "surface", reading);
      if (frame.type != FrameType::cylindrical)
      {
         reading.AddError(path + "." + key,
                          "only a cylindrical frame has an axis somewhere; "
                          "give type = \"cylindrical\", or leave it out");
      }
      else if (also || frame.HasOrigin())
      {
         reading.AddError(path + "." + key,
                          "the axis is said to be somewhere else too; give "
                          "one of origin, between, around");
      }
   };
   check(frame.between, "between", false);
   check(frame.around, "around", !frame.between.empty());
}

void CheckMaterials(const CaseFile &setup, CaseReading &reading)
{
   if (setup.materials.empty() && !reading.HasError("material"))
   {
      reading.AddError("material", "there is no material; every region needs "
                                   "one");
   }
   Once once(reading);
   for (size_t i = 0; i < setup.materials.size(); i++)
   {
      const std::string path = Path("material", i, "regions");
      const std::vector<std::string> &regions = setup.materials[i].regions;
      CheckNames(regions, path, "region", reading);
      CheckFrame(setup.materials[i].frame, Path("material", i, "frame"),
                 reading);
      CheckLaws(setup.materials[i], Path("material", i),
                setup.space.deformation, reading);
      const std::set<std::string> distinct(regions.begin(), regions.end());
      for (const std::string &region : distinct)
      {
         once.Enter(region, path,
                    "the region " + Quoted(region) + " has a material already");
      }
   }
}

constexpr const char *axes[3] = {"x", "y", "z"};

/// What is prescribed where, to find what is prescribed twice.
class Prescriptions
{
public:
   explicit Prescriptions(CaseReading &reading) : once(reading) {}

   void Enter(const BoundaryCase &boundary, const std::string &surface,
              const std::string &path)
   {
      const auto enter =
         [&](bool given, const std::string &key, const std::string &what)
      {
         if (given)
         {
            once.Enter(surface + '\n' + what, path + "." + key,
                       what + " on " + Quoted(surface) +
                          " is prescribed already");
         }
      };
      for (int d = 0; d < 3; d++)
      {
         // A load on what doesn't give would come to nothing.
         const std::string along =
            std::string("displacement, traction or force along ") + axes[d];
         enter(boundary.displacement[d].has_value(), "displacement", along);
         enter(boundary.traction && !IsZero((*boundary.traction)[d]),
               "traction", along);
         enter(boundary.force.Drives(d), "force", along);
      }
      enter(boundary.pressure.has_value(), "pressure", "pressure or flux");
      enter(boundary.normal_flux.has_value(), "normal_flux",
            "pressure or flux");
      enter(boundary.normal_traction.has_value(), "normal_traction",
            "the normal traction");
   }

private:
   static bool IsZero(const LoadCurve &curve)
   {
      const std::vector<real_t> &times = curve.Corners();
      return std::all_of(times.begin(), times.end(),
                         [&](real_t t) { return curve(t) == 0.0; });
   }

   Once once;
};

void CheckBoundaries(const CaseFile &setup, CaseReading &reading)
{
   Prescriptions prescriptions(reading);
   for (size_t i = 0; i < setup.boundaries.size(); i++)
   {
      const BoundaryCase &boundary = setup.boundaries[i];
      const std::string path = Path("boundary", i);
      CheckNames(boundary.surfaces, path + ".surfaces", "surface", reading);
      const auto &u = boundary.displacement;
      const bool moved = u[0] || u[1] || u[2] || boundary.force.curve ||
                         boundary.spring.stiffness > 0.0;
      const std::vector<std::string> keys = {
         "displacement", "pressure", "traction", "normal_traction",
         "normal_flux",  "spring",   "force"};
      const bool written =
         std::any_of(keys.begin(), keys.end(),
                     [&](const std::string &key)
                     { return reading.Places().count(path + "." + key) > 0; });
      if (!moved && !boundary.pressure && !boundary.traction &&
          !boundary.normal_traction && !boundary.normal_flux && !written)
      {
         reading.AddError(path, "nothing is prescribed here; give one of " +
                                   JoinedNames(keys));
      }
      const auto check_pair =
         [&](bool first, bool second, const char *key, const char *problem)
      {
         if (first && !second)
         {
            reading.AddError(path + "." + key, problem);
         }
      };
      const ForceCase &force = boundary.force;
      const bool stiff = boundary.spring.stiffness > 0.0;
      check_pair(boundary.spring.IsDirected(), stiff, "spring",
                 "there is a direction, but no stiffness");
      check_pair(force.IsDirected(), force.curve.has_value(), "force",
                 "there is a direction, but no curve");
      check_pair(force.curve.has_value(), force.IsDirected(), "force",
                 "there is a curve, but no direction");
      const std::set<std::string> distinct(boundary.surfaces.begin(),
                                           boundary.surfaces.end());
      for (const std::string &surface : distinct)
      {
         prescriptions.Enter(boundary, surface, path);
         if (moved && surface.find_first_of(",\"'/\\") != std::string::npos)
         {
            reading.AddError(path + ".surfaces",
                             "the name " + Quoted(surface) +
                                " cannot be a column of the history, for it "
                                "has a comma, a quote or a slash; rename the "
                                "physical surface");
         }
      }
   }
}

void CheckContacts(const CaseFile &setup, CaseReading &reading)
{
   Once names(reading);
   Once pairs(reading);
   std::map<std::string, std::string> held;
   for (size_t i = 0; i < setup.boundaries.size(); i++)
   {
      const BoundaryCase &boundary = setup.boundaries[i];
      for (const std::string &surface : boundary.surfaces)
      {
         if (boundary.pressure || boundary.normal_flux)
         {
            held[surface] = Path(
               "boundary", i, boundary.pressure ? "pressure" : "normal_flux");
         }
      }
   }
   for (size_t i = 0; i < setup.contacts.size(); i++)
   {
      const ContactCase &contact = setup.contacts[i];
      const std::string path = Path("contact", i);
      CheckNames(contact.source, path + ".source", "surface", reading);
      CheckNames(contact.destination, path + ".destination", "surface",
                 reading);
      const std::set<std::string> source(contact.source.begin(),
                                         contact.source.end());
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
            const auto found = held.find(surface);
            if (found != held.end())
            {
               reading.AddError(
                  found->second,
                  "the fluid on " + Quoted(surface) +
                     " is the contact pair's: sealed where it touches, free "
                     "to drain elsewhere (" +
                     WhereIs(reading.Places(), path) + ")");
               held.erase(found);
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
         for (const std::string &a : source)
         {
            for (const std::string &b : contact.destination)
            {
               pairs.Enter(std::min(a, b) + '\n' + std::max(a, b), path,
                           Quoted(a) + " and " + Quoted(b) +
                              " are in a contact pair already");
            }
         }
      }
      if (contact.options.quadrature_order == 3)
      {
         reading.AddError(path + ".quadrature_order",
                          "found 3, which has negative weights; take 4");
      }
   }
}

void CheckTimes(const CaseFile &setup, CaseReading &reading)
{
   const TimeOptions &time = setup.time;
   if (time.end > 0.0 && time.step > 0.0 && time.end / time.step > most_steps)
   {
      reading.AddError("time.step", "the end time of " + ToText(time.end) +
                                       " would take " +
                                       ToText(time.end / time.step) +
                                       " steps; that is too many");
   }
   if (time.min_step > time.step)
   {
      reading.AddError("time.min_step", "found " + ToText(time.min_step) +
                                           "; it must not be above the time "
                                           "step, " +
                                           ToText(time.step));
   }
   if (time.max_step > 0.0 && time.max_step < time.step)
   {
      reading.AddError("time.max_step", "found " + ToText(time.max_step) +
                                           "; it must be at least the time "
                                           "step, " +
                                           ToText(time.step));
   }
}

void CheckOutput(const CaseFile &setup, CaseReading &reading)
{
   if (setup.output.directory.empty())
   {
      reading.AddError("output.directory", "the name is empty");
   }
   Once names(reading);
   for (size_t i = 0; i < setup.output.lines.size(); i++)
   {
      const LineCase &line = setup.output.lines[i];
      const std::string path = Path("output.line", i);
      if (line.line.name.empty())
      {
         if (!reading.HasError(path + ".name"))
         {
            reading.AddError(path + ".name", "the name is empty");
         }
      }
      else
      {
         names.Enter(line.line.name, path + ".name",
                     "a line is called " + Quoted(line.line.name) + " already");
         CheckFileName(line.line.name, path + ".name", reading);
      }
      if (line.line.from == line.line.to && !reading.HasError(path + ".from") &&
          !reading.HasError(path + ".to"))
      {
         reading.AddError(path, "the line has no length");
      }
      for (size_t k = 0; k < line.times.size(); k++)
      {
         if (!(line.times[k] > 0.0))
         {
            reading.AddError(Path(path + ".times", k),
                             "found " + ToText(line.times[k]) +
                                "; it must be positive");
         }
      }
   }
}

void CheckMesh(const MeshCase &mesh, CaseReading &reading)
{
   if (mesh.file.empty() && !reading.HasError("mesh.file"))
   {
      reading.AddError("mesh.file", "the name is empty");
   }
   // Programs elsewhere are none of a case's business.
   if (mesh.generator.script.find_first_of("/\\ ") != std::string::npos)
   {
      reading.AddError("mesh.generator",
                       "found " + Quoted(mesh.generator.script) +
                          "; the first string must be the name of a script in "
                          "meshes/, without a path, and arguments are strings "
                          "of their own");
   }
}
} // namespace

void CheckConsistency(const CaseFile &setup, CaseReading &reading)
{
   CheckMesh(setup.mesh, reading);
   CheckMaterials(setup, reading);
   CheckBoundaries(setup, reading);
   CheckContacts(setup, reading);
   CheckTimes(setup, reading);
   CheckOutput(setup, reading);
}

} // namespace synovia
