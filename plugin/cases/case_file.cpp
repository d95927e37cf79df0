#include "synovia/cases/case_file.hpp"
#include "synovia/cases/case_checks.hpp"
#include "synovia/cases/case_keys.hpp"
#include "synovia/cases/case_steps.hpp"
#include "synovia/general/root_rank.hpp"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace synovia
{

namespace
{
bool IsZero(const std::array<mfem::real_t, 3> &vector)
{
   return vector[0] == 0.0 && vector[1] == 0.0 && vector[2] == 0.0;
}
} // namespace

bool SpringCase::IsDirected() const
{
   return !IsZero(direction);
}

bool SpringCase::Holds(int component) const
{
   return stiffness > 0.0 && (!IsDirected() || direction[component] != 0.0);
}

bool FrameCase::HasOrigin() const
{
   return !IsZero(origin);
}

bool BoundaryCase::Holds(int component) const
{
   return displacement[component].has_value() || spring.Holds(component) ||
          (guide && (*guide)[component] != 0.0);
}

RigidBodyOptions RigidBodyCase::Options() const
{
   RigidBodyOptions options;
   options.reference = reference;
   const bool has_center = shape.type != RigidShape::Type::none &&
                           shape.type != RigidShape::Type::file;
   if (!reference && has_center && surfaces.empty() && regions.empty())
   {
      options.reference = shape.center;
   }
   options.load_follows = load_follows;
   if (relative)
   {
      options.relative_since = begin;
   }
   for (int d = 0; d < 3; d++)
   {
      options.prescribed[d] = translation[d];
      options.prescribed[d + 3] = rotation[d];
      options.stiffness[d] = stiffness[d];
      options.stiffness[d + 3] = rotational_stiffness[d];
      if (force)
      {
         options.load[d] = (*force)[d];
      }
      if (moment)
      {
         options.load[d + 3] = (*moment)[d];
      }
   }
   return options;
}

std::optional<RigidShape> RigidBodyCase::Shape() const
{
   if (shape.type == RigidShape::Type::none)
   {
      return std::nullopt;
   }
   RigidShape named = shape;
   named.name = name;
   return named;
}

std::vector<std::string> RigidBodyCase::AllRegions() const
{
   std::vector<std::string> all = regions;
   if (Shape())
   {
      all.push_back(name);
   }
   return all;
}

bool ForceCase::IsDirected() const
{
   return !IsZero(direction);
}

bool ForceCase::Drives(int component) const
{
   return curve && direction[component] != 0.0;
}

namespace
{
// No case is that long; a mesh given by mistake may be.
constexpr std::uintmax_t longest_file = 4 << 20;

/// The text of the file, or what is wrong with it.
std::string ReadText(const std::string &file, std::string &text)
{
   std::error_code error;
   const std::filesystem::file_status status =
      std::filesystem::status(file, error);
   if (!std::filesystem::exists(status))
   {
      return "there is no such file";
   }
   if (std::filesystem::is_directory(status))
   {
      return "this is a directory; name the case file in it";
   }
   if (std::filesystem::is_regular_file(status) &&
       std::filesystem::file_size(file, error) > longest_file)
   {
      return "the file is too long for a case; is it a mesh?";
   }
   errno = 0;
   std::ifstream stream(file, std::ios::binary);
   std::string block(1 << 16, '\0');
   while (stream && text.size() <= longest_file)
   {
      stream.read(block.data(), static_cast<std::streamsize>(block.size()));
      text.append(block, 0, static_cast<size_t>(stream.gcount()));
   }
   if (text.size() > longest_file)
   {
      return "the file is too long for a case";
   }
   if (!stream.eof())
   {
      return std::string("cannot be read: ") + std::strerror(errno);
   }
   return "";
}

// One in a file is beside it, one from the command line where the user is.
void ResolveFile(const CasePlaces &places, const std::string &path,
                 const std::string &source, std::string &file)
{
   const auto place = places.find(path);
   const bool in_file = place != places.end() && place->second.line > 0;
   if (in_file && !file.empty())
   {
      file = (std::filesystem::path(source).parent_path() / file).string();
   }
}

void ResolveFiles(CaseFile &setup, const std::string &source)
{
   ResolveFile(setup.places, "mesh.file", source, setup.mesh.file);
   for (size_t i = 0; i < setup.rigid_bodies.size(); i++)
   {
      ResolveFile(setup.places,
                  "rigid_body." + std::to_string(i) + ".shape.file", source,
                  setup.rigid_bodies[i].shape.file);
   }
}

void Check(CaseFile &setup, CaseReading &reading)
{
   CaseKeys(setup).Check("", reading);
   CheckConsistency(setup, reading);
   reading.ThrowIfAny();
}
} // namespace

namespace
{
std::string NameOfPair(const std::string &name,
                       const std::vector<std::string> &source,
                       const std::vector<std::string> &destination)
{
   if (!name.empty() || source.empty() || destination.empty())
   {
      return name;
   }
   return source.front() + "-" + destination.front();
}
} // namespace

std::string ContactCase::Name() const
{
   return NameOfPair(name, source, destination);
}

std::string TieCase::Name() const
{
   return NameOfPair(name, source, destination);
}

CaseFile ParseCase(const std::string &text, const std::string &source,
                   const std::vector<std::string> &overrides)
{
   CaseValue root = ParseToml(text, source);
   root.place = {source, 0, 0};
   for (const std::string &assignment : overrides)
   {
      Override(root, assignment);
   }
   CaseFile setup;
   CaseReading reading;
   reading.SetPlace("", root.place);
   // Whether there are steps decides what is required.
   const CaseValue *steps = root.Find("step");
   setup.steps.resize(steps ? steps->items.size() : 0);
   CaseKeys(setup).Read(CaseInput(root, "", reading));
   const mfem::real_t end = EndOfSteps(setup.steps);
   if (end > 0.0 && reading.Places().count("time.end") == 0)
   {
      setup.time.end = end;
   }
   Check(setup, reading);
   setup.places = reading.Places();
   ResolveFiles(setup, source);
   return setup;
}

CaseFile ReadCase(const std::string &file, MPI_Comm comm,
                  const std::vector<std::string> &overrides)
{
   std::string text;
   const std::string problem = IsRoot(comm) ? ReadText(file, text) : "";
   ThrowIfAny(comm, problem.empty() ? problem : file + ": " + problem);
   Broadcast(text, comm);
   return ParseCase(text, file, overrides);
}

void CheckCase(const CaseFile &setup)
{
   CaseReading reading(setup.places);
   CaseFile copy(setup);
   Check(copy, reading);
}

void WriteCase(const CaseFile &setup, std::ostream &out)
{
   CaseFile copy(setup);
   copy.mesh.file = std::filesystem::absolute(copy.mesh.file).string();
   for (RigidBodyCase &body : copy.rigid_bodies)
   {
      if (!body.shape.file.empty())
      {
         body.shape.file = std::filesystem::absolute(body.shape.file).string();
      }
   }
   CaseKeys(copy).Write(out);
}

void ListCaseKeys(std::ostream &out)
{
   CaseFile standard;
   CaseKeys(standard).List(out);
   out << "\nA list of tables has one [[key]] for each of its entries, which "
          "--set counts from 0\n(material.0.solid.E) or names "
          "(contact.NAME.penalty). A curve is "
       << CurveForms()
       << ",\nlinear between the points and constant before and after; with "
          "repeat = N in it,\nN times over.\n";
}

} // namespace synovia
