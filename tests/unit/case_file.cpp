// ranks: 1 2 3

#include "synovia/cases/case_file.hpp"
#include "support/temporary_directory.hpp"
#include "synovia/general/error.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <filesystem>
#include <sstream>

using namespace mfem;
using namespace synovia;
using Catch::Matchers::Contains;

namespace
{
const std::string good = R"(title = "A case"
[mesh]
file = "boxes.msh"
scale = 1000
[[material]]
regions = ["lower", "upper"]
solid = {E = 0.5, nu = 0.1}
permeability = {value = 4e-3}
[[boundary]]
surfaces = ["bone"]
displacement = [0, 0, 0]
[[boundary]]
surfaces = "top"
displacement = ["free", 1, {times = [0, 10], values = [0, -0.1]}]
pressure = {times = [0, 2.5], values = [0, 1e-3]}
[[boundary]]
surfaces = ["side"]
traction = [0, {times = [1, 2], values = [3, 4]}, 5]
normal_flux = -2
[[boundary]]
surfaces = ["lower_rim"]
sealed = true
[[contact]]
source = ["upper_face"]
destination = ["lower_face", "lower_rim"]
penalty = 12.5
configuration = "reference"
quadrature_order = 6
[time]
end = 20
step = 0.5
scheme = "sdirk33"
[solver]
linear = "direct"
max_newton = 7
[output]
directory = "results"
fields_every = 0
[[output.line]]
name = "axis"
from = [0, 0, 0]
to = [0, 0, 1]
region = "lower"
times = [5, 20]
)";

std::string Replaced(std::string text, const std::string &from,
                     const std::string &to)
{
   const size_t at = text.find(from);
   REQUIRE(at != std::string::npos);
   return text.replace(at, from.size(), to);
}

std::string CaseError(const std::string &text,
                      const std::vector<std::string> &overrides = {})
{
   try
   {
      ParseCase(text, "dir/case.toml", overrides);
   }
   catch (const Error &error)
   {
      return error.what();
   }
   return "";
}

std::string Written(const CaseFile &setup)
{
   std::ostringstream out;
   WriteCase(setup, out);
   return out.str();
}
} // namespace

TEST_CASE("A case file fills the structs", "[case]")
{
   const CaseFile setup = ParseCase(good, "dir/case.toml");
   CHECK(setup.title == "A case");
   CHECK(setup.mesh.file == "dir/boxes.msh");
   CHECK(setup.mesh.options.scale == 1000.0);
   CHECK(setup.mesh.options.refine == 0);
   CHECK(setup.mesh.generator.script.empty());
   CHECK(setup.space.order == 2);
   REQUIRE(setup.materials.size() == 1);
   CHECK(setup.materials[0].regions ==
         std::vector<std::string>{"lower", "upper"});
   CHECK(setup.space.deformation == Deformation::infinitesimal);
   CHECK(setup.materials[0].solid.model == "isotropic");
   CHECK(setup.materials[0].solid.parameters.at("E") == 0.5);
   CHECK(setup.materials[0].solid.parameters.at("nu") == 0.1);
   CHECK(setup.materials[0].permeability.parameters.at("value") == 4e-3);
   CHECK(setup.materials[0].solid_fraction == 0.2);
   REQUIRE(setup.boundaries.size() == 4);
   const BoundaryCase &top = setup.boundaries[1];
   CHECK(top.surfaces == std::vector<std::string>{"top"});
   CHECK_FALSE(top.displacement[0]);
   CHECK((*top.displacement[1])(3.0) == 1.0);
   CHECK((*top.displacement[2])(5.0) == Approx(-0.05));
   CHECK((*top.pressure)(2.5) == 1e-3);
   CHECK_FALSE(top.traction);
   const BoundaryCase &side = setup.boundaries[2];
   CHECK((*side.traction)[1](1.5) == 3.5);
   CHECK((*side.traction)[2](7.0) == 5.0);
   CHECK((*side.normal_flux)(0.0) == -2.0);
   CHECK_FALSE(side.sealed);
   CHECK(setup.boundaries[3].sealed);
   REQUIRE(setup.contacts.size() == 1);
   const ContactCase &contact = setup.contacts[0];
   CHECK(contact.Name() == "upper_face-lower_face");
   CHECK(contact.destination ==
         std::vector<std::string>{"lower_face", "lower_rim"});
   CHECK(contact.options.penalty == 12.5);
   CHECK(contact.options.pressure_penalty == 0.0);
   CHECK(contact.options.configuration == SearchConfiguration::reference);
   CHECK(contact.options.quadrature_order == 6);
   CHECK(setup.time.end == 20.0);
   CHECK(setup.time.step == 0.5);
   CHECK(setup.time.scheme == TimeScheme::sdirk33);
   CHECK(setup.solver.linear.method == LinearMethod::direct);
   CHECK(setup.solver.max_newton == 7);
   CHECK(setup.solver.max_augmentations ==
         NonlinearOptions().max_augmentations);
   CHECK(setup.output.directory == "results");
   CHECK(setup.output.fields_every == 0);
   REQUIRE(setup.output.lines.size() == 1);
   CHECK(setup.output.lines[0].line.regions ==
         std::vector<std::string>{"lower"});
   CHECK(setup.output.lines[0].line.points == LineDefinition().points);
   CHECK(setup.output.lines[0].times == std::vector<real_t>{5.0, 20.0});
}

TEST_CASE("A case that is written reads back the same", "[case]")
{
   const CaseFile setup = ParseCase(good, "case.toml");
   const std::string once = Written(setup);
   const CaseFile again = ParseCase(once, "/elsewhere/case.toml");
   CHECK(Written(again) == once);
   CHECK(again.mesh.file == std::filesystem::absolute("boxes.msh"));
   CHECK((*again.boundaries[1].displacement[2])(5.0) == Approx(-0.05));
   CHECK_FALSE(again.boundaries[1].displacement[0]);
}

TEST_CASE("A case says what makes its mesh", "[case]")
{
   const CaseFile setup =
      ParseCase(Replaced(good, "scale = 1000",
                         "generator = [\"hertz.py\", \"--size\", \"1.5\"]"),
                "case.toml");
   CHECK(setup.mesh.generator.script == "hertz.py");
   CHECK(setup.mesh.generator.arguments ==
         std::vector<std::string>{"--size", "1.5"});
   CHECK_THAT(Written(setup),
              Contains("generator = [\"hertz.py\", \"--size\", \"1.5\"]\n"));
   CHECK_THAT(Written(ParseCase(good, "case.toml")), !Contains("generator"));
}

TEST_CASE("A key may have its former name, but not both", "[case]")
{
   const std::string max_newton = "max_newton = 7";
   const auto with = [&](const std::string &line)
   { return Replaced(good, max_newton, max_newton + "\n" + line); };
   for (const std::string name : {"tolerance", "linear_tolerance"})
   {
      const CaseFile setup = ParseCase(with(name + " = 1e-6"), "case.toml");
      CHECK(setup.solver.linear.relative_tolerance == 1e-6);
      CHECK_THAT(Written(setup), Contains("\ntolerance = 1e-06\n") &&
                                    !Contains("linear_tolerance"));
   }
   CHECK_THAT(CaseError(with("tolerance = 1e-6\nlinear_tolerance = 1e-7")),
              Contains("solver.tolerance: it is there as \"linear_tolerance\", "
                       "its former name, too"));
   CHECK_THAT(CaseError(with("linear_tolerance = 2.0")),
              Contains("solver.tolerance: found 2; it must be"));
}

TEST_CASE("Everything that is wrong with a case is said where it is", "[case]")
{
   struct Fault
   {
      std::string from;
      std::string to;
      std::vector<std::string> texts;
   };
   const std::vector<Fault> faults = {
      // What there is not
      {"scale = 1000",
       "scael = 1000",
       {"dir/case.toml:4:1: mesh.scael", "no such key",
        "there are: file, scale, refine", "did you mean \"scale\"?"}},
      {"[solver]", "[sovler]", {"sovler", "did you mean \"solver\"?"}},
      {"E = 0.5", "E = 0.5, K = 2", {":7:", "material.0.solid.K"}},
      {"times = [0, 10], values",
       "times = [0, 10], value",
       {"boundary.1.displacement.2.value", "no such key", "times = [...]"}},
      {"\"sdirk33\"",
       "\"sdirk3\"",
       {"time.scheme", "the string \"sdirk3\"", "\"backward_euler\"",
        "did you mean \"sdirk23\"?"}},
      {"{E = 0.5, nu = 0.1}",
       "{model = \"isotropc\", E = 1, nu = 0}",
       {"material.0.solid.model", "did you mean \"isotropic\"?"}},
      // What is of another type
      {"scale = 1000",
       "scale = \"mm\"",
       {"mesh.scale", "found the string \"mm\"", "expected a number"}},
      {"scale = 1000",
       "refine = 1.0",
       {"mesh.refine", "found the number 1.0", "expected integer"}},
      {"scale = 1000", "refine = true", {"found true", "expected integer"}},
      {"scale = 1000", "refine = 99999999999", {"too large"}},
      {"title = \"A case\"",
       "title = 3",
       {"case.toml:1:", "title", "expected a string"}},
      {"displacement = [0, 0, 0]",
       "displacement = [0, 0]",
       {"boundary.0.displacement", "a list of 2", "a list of 3"}},
      {"displacement = [0, 0, 0]",
       "displacement = [0, \"fre\", 0]",
       {"boundary.0.displacement.1", "the string \"fre\"", "\"free\""}},
      {"displacement = [0, 0, 0]", "displacement = 0", {"a list of 3"}},
      {"[mesh]\nfile = \"boxes.msh\"\nscale = 1000",
       "mesh = \"boxes.msh\"",
       {"mesh", "expected a table"}},
      {"[[contact]]", "[contact]", {"contact", "[[contact]]"}},
      {"scale = 1000",
       "generator = \"boxes.py two_columns\"",
       {"case.toml:4:13: mesh.generator: found the string",
        "expected a list of strings", "[\"boxes.py\", \"two_columns\"]"}},
      {"scale = 1000",
       "generator = [\"boxes.py\", 2]",
       {"mesh.generator.1: found the integer 2; expected a string"}},
      {"scale = 1000",
       "generator = []",
       {"mesh.generator: found an empty list; expected a list of strings"}},
      {"scale = 1000",
       "generator = [\"\", \"two_columns\"]",
       {"mesh.generator: found a list of 2; expected a list of strings"}},
      {"end = 20", "end = 2026-01-01", {"time.end", "a date or time"}},
      // Numbers out of range
      {"E = 0.5",
       "E = 0",
       {"case.toml:7:14: material.0.solid.E: Young's modulus is 0; it must be "
        "positive"}},
      {"nu = 0.1",
       "nu = 0.5",
       {"Poisson's ratio is 0.5", "between -1 and 0.5"}},
      {"value = 4e-3", "value = -4e-3", {"the permeability is -0.004"}},
      {"step = 0.5", "step = nan", {"time.step", "finite"}},
      {"step = 0.5", "step = inf", {"time.step", "finite"}},
      {"step = 0.5", "step = 1e300", {"time.step", "at most 1e+30"}},
      {"step = 0.5", "step = -0.5", {"the time step is -0.5"}},
      {"step = 0.5", "step = 1e-20", {"time.step", "too many"}},
      {"step = 0.5", "step = 0.5\nmin_step = 1", {"time.min_step"}},
      {"scale = 1000", "refine = -1", {"mesh.refine: found -1", "from 0 to 6"}},
      {"scale = 1000", "scale = 0", {"mesh.scale: found 0", "positive"}},
      {"penalty = 12.5", "penalty = 0", {"contact.0.penalty", "\"auto\""}},
      {"penalty = 12.5", "penalty = -1", {"contact.0.penalty"}},
      {"penalty = 12.5", "penalty = \"Auto\"", {"did you mean \"auto\"?"}},
      {"penalty = 12.5",
       "friction.coefficient = 0.1",
       {"contact.0.friction", "physics.deformation = \"finite\""}},
      {"penalty = 12.5",
       "friction.coefficient = -0.1",
       {"contact.0.friction.coefficient: found -0.1"}},
      {"penalty = 12.5",
       "friction.solid_fraction = 1.5",
       {"contact.0.friction.solid_fraction: found 1.5"}},
      {"penalty = 12.5", "friction = 0.1", {"contact.0.friction"}},
      {"quadrature_order = 6", "quadrature_order = 3", {"negative weights"}},
      {"max_newton = 7", "max_newton = 0", {"solver.max_newton: found 0"}},
      {"fields_every = 0",
       "fields_every = -1",
       {"output.fields_every: found -1"}},
      {"region = \"lower\"", "points = 1", {"output.line.0.points: found 1"}},
      // Curves
      {"times = [0, 10], values = [0, -0.1]",
       "times = [0, 10], values = [0]",
       {"boundary.1.displacement.2", "2 times and 1 values"}},
      {"times = [0, 10], values = [0, -0.1]",
       "times = [0, 10]",
       {"boundary.1.displacement.2", "no \"values\""}},
      {"times = [0, 10]",
       "times = [10, 0]",
       {"displacement.2.times.1", "must ascend", "0 follows 10"}},
      {"times = [0, 10]", "times = [0, 0]", {"must ascend"}},
      {"times = [0, 10]", "times = [0, \"x\"]", {"displacement.2.times.1"}},
      {"times = [0, 10]", "times = []", {"0 times and 2 values"}},
      // What is missing
      {"file = \"boxes.msh\"\n", "", {":2:", "mesh.file", "missing"}},
      {"end = 20\n", "", {"time.end", "missing"}},
      {"E = 0.5, ", "", {"material.0.solid.E", "missing", "Young's modulus"}},
      {"solid = {E = 0.5, nu = 0.1}\n", "", {"material.0.solid.E"}},
      {"name = \"axis\"\n", "", {"output.line.0.name", "missing"}},
      {"displacement = [0, 0, 0]", "", {"boundary.0", "nothing is prescribed"}},
      {"regions = [\"lower\", \"upper\"]",
       "regions = []",
       {"material.0.regions", "no region is named"}},
      {"source = [\"upper_face\"]", "source = [\"\"]", {"name is empty"}},
      // Contradictions
      {"scale = 1000",
       "generator = [\"../boxes.py\"]",
       {"mesh.generator: found \"../boxes.py\"", "without a path"}},
      {"scale = 1000",
       "generator = [\"boxes.py two_columns\"]",
       {"mesh.generator", "arguments are strings of their own"}},
      {"[\"lower\", \"upper\"]",
       "[\"lower\", \"lower\"]",
       {"material.0.regions.1", "named twice"}},
      {"surfaces = \"top\"",
       "surfaces = \"bone\"",
       {"boundary.1.displacement", "along y on \"bone\"", "already",
        ":11:16: boundary.0.displacement"}},
      {"surfaces = [\"side\"]",
       "surfaces = [\"top\"]",
       {"pressure or flux on \"top\" is prescribed already"}},
      {"surfaces = [\"side\"]",
       "surfaces = [\"bone\"]",
       {"boundary.2.traction", "displacement, traction or force along y"}},
      {"surfaces = [\"side\"]",
       "surfaces = [\"upper_face\"]",
       {"boundary.2.normal_flux", "contact pair's"}},
      {"normal_flux = -2",
       "normal_flux = -2\nsealed = true",
       {"pressure or flux on \"side\" is prescribed already"}},
      {"[\"lower_face\", \"lower_rim\"]",
       "[\"lower_face\", \"upper_face\"]",
       {"contact.0.destination", "can't touch itself"}},
      {"to = [0, 0, 1]", "to = [0, 0, 0]", {"output.line.0", "no length"}},
      {"times = [5, 20]", "times = [0, 20]", {"output.line.0.times.0"}},
      {"name = \"axis\"", "name = \"a/b\"", {"output.line.0.name", "slash"}},
      {"name = \"axis\"", "name = \"a\\u0000b\"", {"control characters"}},
      {"{E = 0.5, nu = 0.1}",
       "{model = \"transversely_isotropic\", E_r = 1, nu_rtheta = 0, nu_rz = "
       "0, G_rtheta = 1}",
       {"material.0.solid.E_theta", "this is missing"}},
      {"surfaces = \"top\"",
       "surfaces = \"top\"\nspring = {direction = [0, 0, 1]}",
       {"boundary.1.spring", "there is a direction, but no stiffness"}},
      {"displacement = [0, 0, 0]",
       "displacement = [0, 0, {times = [0, 1], values = [0, 1], repeat = 2}]",
       {"boundary.0.displacement.2", "end with the value that it begins"}},
      {"displacement = [0, 0, 0]",
       "displacement = [0, 0, {times = [0, 1], values = [0, 0], repeat = 0}]",
       {"boundary.0.displacement.2.repeat", "repeats from 1 to"}},
      {"surfaces = \"top\"",
       "surfaces = \"top\"\nforce = {curve = 1}",
       {"boundary.1.force", "there is a curve, but no direction"}},
      {"surfaces = \"top\"",
       "surfaces = \"top\"\nforce = {direction = [0, 0, 1]}",
       {"boundary.1.force", "there is a direction, but no curve"}},
      {"permeability = {value = 4e-3}",
       "permeability = {value = 4e-3}\nmean_dilatation = true\n[space]\norder "
       "= 2",
       {"material.0.mean_dilatation", "order 1", "order 2 don't need it"}},
      {"E = 0.5",
       "E = 0.5, E_r = 2",
       {"material.0.solid.E_r", "\"transversely_isotropic\"",
        "not with \"isotropic\""}},
      // What is not TOML
      {"scale = 1000", "scale = ", {"dir/case.toml:4:", "not TOML"}},
      {"scale = 1000", "file = \"b\"", {"dir/case.toml:4:", "not TOML"}},
      {"[time]", "[=time]", {"dir/case.toml:29:1: this is not TOML"}},
      {"[time]", "[(time]", {"dir/case.toml:29:1: this is not TOML"}},
      {"[time]", "[time", {"dir/case.toml:", "not TOML"}},
      {"scale = 1000", "sc\xc3\xa9le = 1000", {"dir/case.toml:4:"}},
      {"scale = 1000", "scale = \xe3\x80\x81 1000", {"dir/case.toml:4:"}},
   };
   for (const Fault &fault : faults)
   {
      const std::string said = CaseError(Replaced(good, fault.from, fault.to));
      CAPTURE(fault.to, said);
      REQUIRE_FALSE(said.empty());
      CHECK(std::count(said.begin(), said.end(), '\n') <= 1);
      for (const std::string &text : fault.texts)
      {
         CHECK_THAT(said, Contains(text));
      }
   }
}

TEST_CASE("All that is wrong is said at once, in the order of the file",
          "[case]")
{
   std::string text = Replaced(good, "scale = 1000", "scale = -1");
   text = Replaced(text, "nu = 0.1", "nu = 3");
   text = Replaced(text, "scheme =", "sceme =");
   const std::string said = CaseError(text);
   CAPTURE(said);
   CHECK(said.find("mesh.scale") < said.find("solid.nu"));
   CHECK(said.find("solid.nu") < said.find("time.sceme"));
   CHECK_THAT(said, Contains("sceme"));

   std::string many = good;
   for (int i = 0; i < 15; i++)
   {
      many += "unknown" + std::to_string(i) + " = 1\n";
   }
   CHECK_THAT(CaseError(many), Contains("and 5 more"));
   CHECK_THAT(CaseError(""), Contains("mesh.file") && Contains("time.end") &&
                                Contains("time.step") && Contains("material"));
}

TEST_CASE("Keys can be overridden", "[case]")
{
   const CaseFile setup = ParseCase(
      good, "dir/case.toml",
      {"time.step=5", "contact.0.penalty = \"auto\"", "contact.0.name=\"pair\"",
       "contact.pair.gap_tolerance=1e-3", "material.upper.solid.E=2",
       "boundary.top.displacement.1=\"free\"", "output.line=[]",
       "solver.max_newton=9", "time.step=2.5", "mesh.file=\"here.msh\"",
       "space.order=1"});
   CHECK(setup.time.step == 2.5);
   CHECK(setup.contacts[0].options.penalty == 0.0);
   CHECK(setup.contacts[0].options.gap_tolerance == 1e-3);
   CHECK(setup.materials[0].solid.parameters.at("E") == 2.0);
   CHECK_FALSE(setup.boundaries[1].displacement[1]);
   CHECK(setup.boundaries[1].displacement[2]);
   CHECK(setup.output.lines.empty());
   CHECK(setup.solver.max_newton == 9);
   CHECK(setup.space.order == 1);
   // From the command line it is relative to where the user is.
   CHECK(setup.mesh.file == "here.msh");
}

TEST_CASE("Impossible overrides say why", "[case]")
{
   const auto check =
      [](const std::string &assignment, const std::vector<std::string> &texts)
   {
      const std::string said = CaseError(good, {assignment});
      CAPTURE(said);
      CHECK_THAT(said, Contains("--set " + assignment));
      for (const std::string &text : texts)
      {
         CHECK_THAT(said, Contains(text));
      }
   };
   check("time.step", {"key.path=value"});
   check("=5", {"not a path"});
   check("time..step=5", {"not a path"});
   check("time.step=", {"no value"});
   check("time.step=5\nx = 3", {"no value"});
   check("solver.linear=direct", {"double quotes"});
   check("time.stpe=5", {"time.stpe", "did you mean \"step\"?"});
   check("time.step=-5", {"the time step is -5"});
   check("contact.1.penalty=5", {"no entry 1", "has 1"});
   check("material.uper.solid_fraction=0.5", {"did you mean \"upper\"?"});
   check("title.x=5", {"no \"x\" in the string"});
}

TEST_CASE("A case that a program made is checked as well", "[case]")
{
   CaseFile setup = ParseCase(good, "case.toml");
   setup.places.clear();
   CHECK_NOTHROW(CheckCase(setup));
   setup.materials[0].solid.parameters["E"] = -1.0;
   CHECK_THROWS_WITH(CheckCase(setup),
                     "material.0.solid.E: Young's modulus is -1; it must be "
                     "positive");
   setup.materials.clear();
   CHECK_THROWS_WITH(CheckCase(setup), Contains("there is no material"));
}

TEST_CASE("All ranks read a file alike, or fail to", "[case]")
{
   const TemporaryDirectory directory;
   const std::string file = directory.Write("case.toml", good);
   const CaseFile setup = ReadCase(file, MPI_COMM_WORLD);
   CHECK(setup.time.end == 20.0);
   CHECK(setup.mesh.file == directory / "boxes.msh");
   CHECK_THROWS_WITH(ReadCase(directory / "none.toml", MPI_COMM_WORLD),
                     Contains("none.toml: there is no such file"));
   CHECK_THROWS_WITH(ReadCase(directory / "", MPI_COMM_WORLD),
                     Contains("this is a directory"));
   const std::string bad = directory.Write("bad.toml", "[mesh]\nfiel = 1\n");
   CHECK_THROWS_WITH(ReadCase(bad, MPI_COMM_WORLD),
                     Contains("bad.toml:2:1: mesh.fiel"));
}

TEST_CASE("The list of keys has them all", "[case]")
{
   std::ostringstream out;
   ListCaseKeys(out);
   const std::string text = out.str();
   for (const char *key :
        {"mesh.file ", "mesh.scale ", "mesh.generator ", "material.N.solid.E ",
         "material.N.solid.nu_rtheta ", "material.N.frame.axis ",
         "boundary.N.displacement ", "boundary.N.normal_traction ",
         "boundary.N.spring.stiffness ", "boundary.N.force.curve ",
         "rigid_body.N.rotation ", "contact.N.penalty ",
         "contact.N.search_radius ", "contact.N.friction.coefficient ",
         "time.adaptive ", "solver.linear ", "output.line.N.times ",
         "output.checkpoint_every "})
   {
      CHECK_THAT(text, Contains("\n" + std::string(key)));
   }
}
