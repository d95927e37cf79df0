// ranks: 1 2
//
// Rigid regions and shapes, elastic solids and gravity in case files: what they
// say, what is refused and where, that they are written as they are read, and
// what --check tells.

#include "support/boxes.hpp"
#include "support/temporary_directory.hpp"
#include "synovia/cases/case_mesh.hpp"
#include "synovia/cases/case_problem.hpp"
#include "synovia/general/error.hpp"
#include "synovia/io/step_diagnostics.hpp"
#include "synovia/runs/problem_report.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <fstream>
#include <sstream>

using namespace mfem;
using namespace synovia;
using Catch::Matchers::Contains;

namespace
{
const std::string good = R"([mesh]
file = "box.msh"
[physics]
acceleration = [0, 0, {times = [0, 1], values = [0, -10]}]
[[material]]
regions = "bone"
solid = {E = 20, nu = 0.3}
permeability = {model = "none"}
solid_density = 2e-3
[[material]]
regions = "cartilage"
solid = {E = 0.5, nu = 0.1}
permeability = {value = 4e-3}
solid_density = 1.5e-3
fluid_density = 1e-3
[[boundary]]
surfaces = "bottom"
displacement = [0, 0, 0]
[[rigid_body]]
name = "indenter"
shape = {type = "sphere", center = [0.5, 0.5, 3.1], radius = 1, facet_size = 0.4}
translation = [0, 0, "free"]
rotation = [0, 0, 0]
force = [0, 0, {times = [0, 1], values = [0, -0.01]}]
[[contact]]
source = "indenter"
destination = "top"
fluid = "draining"
[time]
end = 1
step = 0.5
)";

std::string Replaced(std::string text, const std::string &from,
                     const std::string &to)
{
   const size_t at = text.find(from);
   REQUIRE(at != std::string::npos);
   return text.replace(at, from.size(), to);
}

/// Two bodies that share nodes, bone below cartilage, in a file.
class BoxFile
{
public:
   BoxFile() : directory(MPI_COMM_WORLD)
   {
      directory.OnRootOnly([&]() { std::ofstream(Path()) << Text(); });
   }
   std::string Path() const { return directory.Path() + "/box.msh"; }
   CaseFile Case(const std::string &text) const
   {
      CaseFile setup = ParseCase(text, "case.toml");
      setup.mesh.file = Path();
      return setup;
   }

private:
   static std::string Text()
   {
      std::ostringstream out;
      out << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n4\n"
             "3 1 \"bone\"\n3 2 \"cartilage\"\n2 3 \"bottom\"\n2 4 \"top\"\n"
             "$EndPhysicalNames\n$Nodes\n27\n";
      for (int i = 0; i < 27; i++)
      {
         out << i + 1 << ' ' << 0.5 * (i % 3) << ' ' << 0.5 * (i / 3 % 3) << ' '
             << i / 9 << '\n';
      }
      out << "$EndNodes\n$Elements\n16\n";
      int number = 0;
      const auto corner = [](int i, int j, int k)
      { return 1 + i + 3 * j + 9 * k; };
      const auto square = [&](int i, int j, int k)
      {
         out << ' ' << corner(i, j, k) << ' ' << corner(i + 1, j, k) << ' '
             << corner(i + 1, j + 1, k) << ' ' << corner(i, j + 1, k);
      };
      for (int c = 0; c < 8; c++)
      {
         const int i = c % 2;
         const int j = c / 2 % 2;
         const int k = c / 4;
         out << ++number << " 5 2 " << k + 1 << ' ' << k + 1;
         square(i, j, k);
         square(i, j, k + 1);
         out << '\n';
      }
      for (int c = 0; c < 8; c++)
      {
         const int top = c / 4;
         out << ++number << " 3 2 " << 3 + top << ' ' << 3 + top;
         square(c % 2, c / 2 % 2, 2 * top);
         out << '\n';
      }
      out << "$EndElements\n";
      return out.str();
   }

   TemporaryDirectory directory;
};

std::string ErrorOf(const BoxFile &file, const std::string &text)
{
   try
   {
      const CaseFile setup = file.Case(text);
      NamedMesh mesh = ReadCaseMesh(setup, MPI_COMM_WORLD);
      CaseProblem problem(setup, mesh);
      problem.Get().Operator();
   }
   catch (const Error &error)
   {
      return error.what();
   }
   return "";
}
} // namespace

TEST_CASE("A sphere presses cartilage on a bone without fluid")
{
   const BoxFile file;
   const CaseFile setup = file.Case(good);
   NamedMesh mesh = ReadCaseMesh(setup, MPI_COMM_WORLD);
   CaseProblem problem(setup, mesh);
   std::ostringstream report;
   ProblemReport(setup, problem).Write(report);
   CHECK_THAT(report.str(), Contains("no fluid"));
   CHECK_THAT(report.str(), Contains("rigid"));
   CHECK_THAT(report.str(), !Contains("warning"));
   TimeStepper stepper(problem.Get(), setup.time);
   StepReport step;
   while (!stepper.Done())
   {
      step = stepper.Step();
      INFO(step.reason);
      REQUIRE(step.converged);
   }
   const History::Row row = StepDiagnostics(problem.Get(), stepper, step);
   const auto value = [&](const std::string &name)
   {
      const auto found =
         std::find_if(row.begin(), row.end(),
                      [&](const auto &entry) { return entry.first == name; });
      REQUIRE(found != row.end());
      return found->second;
   };
   CHECK(value("contact.indenter-top.force_z") == Approx(-0.01).epsilon(1e-6));
   CHECK(value("rigid_body.indenter.force_z") == Approx(-0.01));
   CHECK(value("rigid_body.indenter.translation_z") < -0.1);
   CHECK(value("contact.indenter-top.fluid_exchange") == 0.0);
   // Weights of bone and cartilage, of a volume of 1 each.
   const real_t weight = 10.0 * (2e-3 + 0.2 * 1.5e-3 + 0.8 * 1e-3);
   CHECK(value("reaction.bottom.z") == Approx(0.01 + weight).epsilon(1e-6));
}

TEST_CASE("Cases with shapes are written as they are read")
{
   const CaseFile setup = ParseCase(good, "case.toml");
   std::ostringstream once;
   WriteCase(setup, once);
   const CaseFile again = ParseCase(once.str(), "written.toml");
   std::ostringstream twice;
   WriteCase(again, twice);
   CHECK(once.str() == twice.str());
   REQUIRE(again.rigid_bodies.size() == 1);
   const RigidShape shape = *again.rigid_bodies[0].Shape();
   CHECK(shape.name == "indenter");
   CHECK(shape.type == RigidShape::Type::sphere);
   CHECK(shape.radius == 1.0);
   CHECK(again.contacts[0].options.dry_partner == DryPartner::draining);
   CHECK_FALSE(again.materials[0].HasFluid());
   CHECK(again.materials[1].fluid_density == 1e-3);
   CHECK((*again.acceleration)[2](0.5) == -5.0);
}

TEST_CASE("All nodes of a rigid region are tied, and no others")
{
   // The sides of both regions have no name, and so one attribute.
   const BoxFile file;
   const CaseFile setup = file.Case(R"([mesh]
file = "box.msh"
[space]
order = 1
[[material]]
regions = "cartilage"
solid = {E = 0.5, nu = 0.1}
permeability = {value = 4e-3}
[[rigid_body]]
name = "bone"
regions = "bone"
translation = [0, 0, 0]
rotation = [0, 0, 0]
[[boundary]]
surfaces = "top"
pressure = 0
normal_traction = -0.01
[time]
end = 1
step = 1
)");
   NamedMesh mesh = ReadCaseMesh(setup, MPI_COMM_WORLD);
   CaseProblem problem(setup, mesh);
   const RigidTies &ties = problem.Get().Operator().Equations().Ties();
   int nodes = static_cast<int>(ties.Nodes(0).Get().size());
   MPI_Allreduce(MPI_IN_PLACE, &nodes, 1, MPI_INT, MPI_SUM, MPI_COMM_WORLD);
   CHECK(nodes == 18);
   TimeStepper stepper(problem.Get(), setup.time);
   const StepReport report = stepper.Step();
   INFO(report.reason);
   REQUIRE(report.converged);
   CHECK(problem.Get().RigidBodyStates().front().force[2] ==
         Approx(0.01).epsilon(1e-6));
}

TEST_CASE("What is wrong with elastic and rigid parts is said with its place")
{
   struct Wrong
   {
      std::string from;
      std::string to;
      std::vector<std::string> texts;
   };
   const Wrong wrong = GENERATE(values<Wrong>({
      {"type = \"sphere\"",
       "type = \"cone\"",
       {"rigid_body.0.shape.type", "\"cylinder\""}},
      {"radius = 1,", "", {"rigid_body.0.shape.radius", "missing"}},
      {"radius = 1,", "radius = 0,", {"rigid_body.0.shape", "positive"}},
      {"radius = 1,",
       "radius = 1, edge = 2,",
       {"rigid_body.0.shape.edge", "\"plane\""}},
      {"shape = {type = \"sphere\", center = [0.5, 0.5, 3.1], radius = 1, "
       "facet_size = 0.4}\n",
       "",
       {"rigid_body.0.surfaces", "name at least one"}},
      {"shape = {type = \"sphere\", center = [0.5, 0.5, 3.1], radius = 1, "
       "facet_size = 0.4}\n",
       "regions = \"cartilage\"\n",
       {"rigid_body.0.regions", "\"cartilage\" has a material"}},
      {"name = \"indenter\"",
       "name = \"bone\"",
       {"makes a region of a name that the mesh has already"}},
      {"type = \"sphere\", center = [0.5, 0.5, 3.1], radius = 1, facet_size = "
       "0.4",
       "type = \"file\", file = \"nowhere.stl\"",
       {"the shape of \"indenter\"", "nowhere.stl", "cannot be read"}},
      {"source = \"indenter\"\ndestination = \"top\"",
       "source = \"top\"\ndestination = \"indenter\"",
       {"its destination is a rigid body"}},
      {"fluid = \"draining\"",
       "fluid = \"open\"",
       {"contact.0.fluid", "\"impermeable\""}},
      {"model = \"none\"",
       "model = \"none\", value = 1",
       {"material.0.permeability.value"}},
      {"surfaces = \"bottom\"\n",
       "surfaces = \"bottom\"\npressure = 0\n",
       {"\"bottom\", but the body there has none"}},
      {"solid_density = 2e-3",
       "solid_density = -1",
       {"material.0.solid_density"}},
      {"[0, 0, {times = [0, 1], values = [0, -10]}]",
       "[0, 0]",
       {"physics.acceleration", "list of 3"}},
   }));
   CAPTURE(wrong.from, wrong.to);
   const BoxFile file;
   const std::string error =
      ErrorOf(file, Replaced(good, wrong.from, wrong.to));
   for (const std::string &part : wrong.texts)
   {
      CHECK_THAT(error, Contains(part));
   }
   CHECK(ErrorOf(file, good).empty());
}

TEST_CASE("What is wrong with a shape is said with its key")
{
   struct Wrong
   {
      std::string shape;
      std::vector<std::string> texts;
   };
   const std::string place = "center = [0.5, 0.5, 3]";
   const std::string plane = "type = \"plane\", " + place;
   const std::string roller = "type = \"cylinder\", " + place;
   const std::string sphere = "type = \"sphere\", ";
   const std::string of_file = "type = \"file\", file = \"it.stl\"";
   const std::string key = "rigid_body.0.shape.";
   const auto wrong = GENERATE_COPY(values<Wrong>({
      {sphere + "radius = 1", {key + "center: this is missing"}},
      {sphere + "center = [0.5, 3], radius = 1",
       {key + "center: found a list of 2", "a list of 3 numbers"}},
      {sphere + "center = [0.5, 0.5, inf], radius = 1",
       {key + "center.2", "finite"}},
      {sphere + place + ", radius = 1, hollow = 1",
       {key + "hollow: found the integer 1", "true or false"}},
      {sphere + place + ", radius = 1, normal = [0, 0, 1]",
       {key + "normal", "\"plane\""}},
      {sphere + place + ", radius = 1, height = 1",
       {key + "height", "\"cylinder\""}},
      {sphere + place + ", radius = 1, facet_size = 0",
       {key + "facet_size: found 0", "\"auto\""}},
      {sphere + place + ", radius = 1, facet_size = 1e-4",
       {"the shape of \"indenter\"", "facets of 0.0001 are too small"}},
      {plane + ", edge = 2, normal = [0, 0, 0]",
       {"the shape of \"indenter\"", "the length of the normal is 0"}},
      {plane + ", edge = 2, normal = 1",
       {key + "normal: found the integer 1", "a list of 3 numbers"}},
      {plane + ", normal = [0, 0, -1]", {key + "edge: this is missing"}},
      {plane + ", edge = 0", {key + "edge: found 0; it must be positive"}},
      {plane + ", edge = \"2\"", {key + "edge: found the string"}},
      {plane + ", edge = 2, hollow = true", {key + "hollow", "\"sphere\""}},
      {roller + ", radius = 1, height = 1, axis = [0, 0, 0]",
       {"the shape of \"indenter\"", "the length of the axis is 0"}},
      {roller + ", radius = 1, height = 1, axis = [0, 1]",
       {key + "axis: found a list of 2"}},
      {roller + ", radius = 1", {key + "height: this is missing"}},
      {roller + ", radius = 1, height = -1",
       {key + "height: found -1; it must be positive"}},
      {roller + ", radius = 1, height = [1]",
       {key + "height: found a list of 1"}},
      {of_file + ", scale = 0", {key + "scale: found 0; it must be positive"}},
      {of_file + ", scale = \"mm\"", {key + "scale: found the string \"mm\""}},
      {of_file + ", " + place, {key + "center", "not with \"file\""}},
      {"type = \"file\", file = [\"it.stl\"]",
       {key + "file: found a list of 1", "a string"}},
      {"type = \"none\", radius = 1", {key + "radius", "not with \"none\""}},
   }));
   CAPTURE(wrong.shape);
   const BoxFile file;
   const std::string error = ErrorOf(
      file, Replaced(good,
                     "type = \"sphere\", center = [0.5, 0.5, 3.1], radius = 1, "
                     "facet_size = 0.4",
                     wrong.shape));
   for (const std::string &part : wrong.texts)
   {
      CHECK_THAT(error, Contains(part));
   }
}

TEST_CASE("An acceleration needs something that is heavy")
{
   std::string text = Replaced(good, "solid_density = 2e-3\n", "");
   text = Replaced(text, "solid_density = 1.5e-3\nfluid_density = 1e-3\n", "");
   CHECK_THROWS_WITH(ParseCase(text, "case.toml"),
                     Contains("physics.acceleration") &&
                        Contains("no material has a density"));
}
