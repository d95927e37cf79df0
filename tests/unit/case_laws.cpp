// ranks: 1 2
//
// Laws in case files: each law and each of its parameters, what is wrong with
// them, the deformation that they are for, mixtures, and a law of the user's
// own.

#include "support/boxes.hpp"
#include "support/deformed_point.hpp"
#include "synovia/cases/case_problem.hpp"
#include "synovia/synovia.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <sstream>

using namespace mfem;
using namespace synovia;
using Catch::Contains;

namespace
{
const std::string linear_solid = "{model = \"isotropic\", E = 0.5, nu = 0.1}";
const std::string ground = "{model = \"neo_hookean\", E = 0.5, nu = 0.1}";
const std::string constant = "{model = \"constant\", value = 4e-3}";

std::string Text(const std::string &deformation, const std::string &solid,
                 const std::string &permeability)
{
   return "mesh = {file = \"box.msh\"}\n"
          "[space]\n"
          "order = 1\n"
          "[physics]\n"
          "deformation = \"" +
          deformation +
          "\"\n"
          "[[material]]\n"
          "regions = \"body\"\n"
          "solid = " +
          solid + "\npermeability = " + permeability +
          "\n"
          "frame = {axis = [1, 0, 0]}\n"
          "[[boundary]]\n"
          "surfaces = \"z0\"\n"
          "displacement = [0, 0, 0]\n"
          "[time]\n"
          "end = 1\n"
          "step = 1\n";
}

std::string CaseError(const std::string &text)
{
   try
   {
      ParseCase(text, "case.toml");
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

NamedMesh OneBox()
{
   BoxOptions box;
   box.nz = 2;
   return MakeBox(box);
}

/// A number that the range has, or that it does not have.
real_t Inside(const NumberRange &range)
{
   const real_t number = std::isfinite(range.most)
                            ? 0.5 * (range.least + range.most)
                            : std::max(range.least, 0.0) + 1.5;
   return range.Has(number) ? number : 0.25;
}

/// Whether a law makes a body with a ground matrix only.
bool NeedsGround(const LawDescription &law)
{
   return law.is_fiber || law.has_fibers || law.name == "donnan" ||
          law.name == "ellipsoidal_fiber_distribution";
}

/// The table of a law, with a parameter left out, or with another value.
std::string TableOf(const LawDescription &law, const std::string &changed = "",
                    const std::string &value = "")
{
   std::string text = "{model = \"" + law.name + "\"";
   for (const LawParameter &parameter : law.parameters)
   {
      const std::string own = parameter.name == changed
                                 ? value
                                 : ShortestNumber(Inside(parameter.range));
      text += own.empty() ? "" : ", " + parameter.name + " = " + own;
   }
   for (const LawVector &vector : law.vectors)
   {
      const std::string number = ShortestNumber(Inside(vector.range));
      const std::string own =
         vector.name == changed
            ? value
            : "[" + number + ", " + number + ", " + number + "]";
      text += own.empty() ? "" : ", " + vector.name + " = " + own;
   }
   if (law.has_fibers)
   {
      text += ", fibers = {model = \"fiber_pow\", ksi = 2, beta = 2.5}";
   }
   if (law.has_parts)
   {
      text += ", solids = [" + ground + ", {model = \"fiber_nh\", mu = 2}]";
   }
   return text + "}";
}

std::string Deformed(const LawDescription &law, bool other = false)
{
   const Deformation own = law.only_for.value_or(Deformation::infinitesimal);
   return (own == Deformation::finite) != other ? "finite" : "infinitesimal";
}

/// A law in a case: alone, or in a ground matrix.
std::string SolidTable(const LawDescription &law, const std::string &table)
{
   return NeedsGround(law)
             ? "{model = \"mixture\", solids = [" + ground + ", " + table + "]}"
             : table;
}

/// One that tests itself: a spring between all points and nothing else.
class Toy : public DifferentiatedSolid<Toy>
{
public:
   static LawDescription Describe()
   {
      return {"toy",
              "of this test",
              Deformation::finite,
              {{"c", "stress", "the modulus c", NumberRange::Positive(), {}}}};
   }
   explicit Toy(const LawArguments &from) : c(from["c"]) {}
   template <typename T>
   bool Stress(const MaterialPoint &, const Tensor3<T> &F, Tensor3<T> &P) const
   {
      const Tensor3<T> cofactor = Cofactor(F);
      P = c * F - (c / Determinant(F, cofactor)) * cofactor;
      return true;
   }
   real_t AggregateModulus() const override { return 2.0 * c; }
   real_t ShearModulus() const override { return c; }

private:
   real_t c;
};
} // namespace

TEST_CASE("Each law goes from the case file into the problem", "[case]")
{
   NamedMesh mesh = OneBox();
   int made = 0;
   const auto make = [&](const std::string &text)
   {
      CAPTURE(text);
      const CaseFile setup = ParseCase(text, "case.toml");
      const std::string once = Written(setup);
      CHECK(Written(ParseCase(once, "case.toml")) == once);
      CaseProblem problem(setup, mesh);
      CHECK(problem.Get().GetDeformation() == setup.space.deformation);
      made++;
   };
   for (const auto &entry : SolidLaws().Entries())
   {
      const LawDescription &law = entry.description;
      if (law.name == "transversely_isotropic")
      {
         continue; // its constants depend on each other
      }
      make(Text(Deformed(law), SolidTable(law, TableOf(law)), constant));
   }
   for (const auto &entry : PermeabilityLaws().Entries())
   {
      const LawDescription &law = entry.description;
      const bool finite = Deformed(law) == "finite";
      make(Text(Deformed(law), finite ? ground : linear_solid, TableOf(law)));
   }
   make(Text("infinitesimal",
             "{model = \"transversely_isotropic\", E_r = 0.075, E_theta = 100, "
             "nu_rtheta = 0.0015, nu_rz = 0.5, G_rtheta = 0.05}",
             constant));
   CHECK(made >= 18);
}

TEST_CASE("Parameters arrive where they belong", "[case]")
{
   NamedMesh mesh = OneBox();
   const CaseFile setup = ParseCase(
      Text("finite",
           "{model = \"mixture\", solids = [{model = \"holmes_mow\", E = 0.5, "
           "nu = 0.1, beta = 0.35}, {model = \"fiber_exp_pow\", alpha = 1, "
           "beta = 2.5, ksi = 5, direction = [0, 2, 2]}]}",
           "{model = \"exponential\", value = 2e-3, M = 3}"),
      "case.toml");
   REQUIRE(setup.materials[0].solid.solids.size() == 2);
   CHECK(setup.materials[0].solid.solids[1].parameters.at("ksi") == 5.0);
   CaseProblem problem(setup, mesh);
   const Material &material = problem.Get().Materials().Get(1);
   const CartesianFrame frame(Point3{{1.0, 0.0, 0.0}});
   const HolmesMow matrix(0.5, 0.1, 0.35);
   const FiberExpPow fibers(1.0, 2.5, 5.0, 0.0, 1.0,
                            FiberDirection(frame, {{0.0, 1.0, 1.0}}));
   const ExponentialPermeability permeability(2e-3, 3.0, 0.2);
   AnyPoint point;
   const Tensor3<> F = SomeDeformation();
   Tensor3<> found;
   Tensor3<> expected;
   Tensor3<> added;
   REQUIRE(material.solid->GetStress(point.Get(), F, found, nullptr));
   matrix.GetStress(point.Get(), F, expected, nullptr);
   fibers.GetStress(point.Get(), F, added, nullptr);
   CHECK(AreClose(expected + added, found, 1e-14));
   REQUIRE(
      material.permeability->GetReferential(point.Get(), F, found, nullptr));
   permeability.GetReferential(point.Get(), F, expected, nullptr);
   CHECK(AreClose(expected, found, 1e-14));
   // What has a standard value is written with it.
   CHECK_THAT(
      Written(setup),
      Contains("solid = {model = \"mixture\", solids = [{model = "
               "\"holmes_mow\", E = 0.5, nu = 0.1, beta = 0.35}, "
               "{model = \"fiber_exp_pow\", alpha = 1.0, beta = 2.5, "
               "ksi = 5.0, mu = 0.0, lam0 = 1.0, direction = [0.0, 2.0, "
               "2.0]}]}\n"));
}

TEST_CASE("A distribution in a case has its fibers", "[case]")
{
   NamedMesh mesh = OneBox();
   const std::string text = Text(
      "finite",
      "{model = \"mixture\", solids = [" + ground +
         ", {model = \"continuous_fiber_distribution\", b = 2, spa = [1, 2, "
         "3], "
         "fibers = {model = \"fiber_pow\", ksi = 4, beta = 3}}, {model = "
         "\"ellipsoidal_fiber_distribution\", beta = [2, 2.5, 3], ksi = [1, 2, "
         "3]}]}",
      constant);
   const CaseFile setup = ParseCase(text, "case.toml");
   CaseProblem problem(setup, mesh);
   const CartesianFrame frame(Point3{{1.0, 0.0, 0.0}});
   const NeoHookean matrix(0.5, 0.1);
   const FiberPow fiber(4.0, 3.0, frame);
   const ContinuousFiberDistribution spread(fiber, {2.0, {{1.0, 2.0, 3.0}}},
                                            frame);
   const EllipsoidalFiberDistribution ellipsoidal({{2.0, 2.5, 3.0}},
                                                  {{1.0, 2.0, 3.0}}, frame);
   const SolidMixture expected({&matrix, &spread, &ellipsoidal});
   AnyPoint point;
   Tensor3<> P;
   Tensor3<> found;
   expected.GetStress(point.Get(), SomeDeformation(), P, nullptr);
   problem.Get().Materials().Get(1).solid->GetStress(
      point.Get(), SomeDeformation(), found, nullptr);
   CHECK(AreClose(P, found, 1e-14));
   CHECK_THAT(Written(setup),
              Contains("{model = \"continuous_fiber_distribution\", b = 2.0, "
                       "spa = [1.0, 2.0, 3.0], fibers = {model = "
                       "\"fiber_pow\", ksi = 4.0, beta = 3.0}}"));
   const auto said = [&](const std::string &before, const std::string &after)
   {
      std::string changed = text;
      changed.replace(changed.find(before), before.size(), after);
      return CaseError(changed);
   };
   const std::string path = "material.0.solid.solids.1.fibers";
   CHECK_THAT(said("fiber_pow", "neo_hookean"),
              Contains(path + ".model: found the string \"neo_hookean\"; "
                              "expected \"fiber_exp_pow\""));
   CHECK_THAT(said("beta = 3}}", "beta = 3, direction = [1, 0, 0]}}"),
              Contains(path + ".direction: there is no such key"));
   CHECK_THAT(said(", fibers = {model = \"fiber_pow\", ksi = 4, beta = 3}", ""),
              Contains(path + ".ksi: this is missing"));
   CHECK_THAT(said("beta = 3}}", "beta = 1}}"),
              Contains(path + ".beta: the exponent beta of the fibers is 1"));
   CaseFile made = setup;
   made.places.clear();
   made.materials[0].solid.solids[1].fibers.parameters["c"] = 1.0;
   CHECK_THROWS_WITH(CheckCase(made),
                     Contains(path + ".c: \"fiber_pow\" has no such "
                                     "parameter"));
}

TEST_CASE("Each parameter of each law must be there and in its range", "[case]")
{
   int parameters = 0;
   const auto check =
      [&](const LawDescription &law, const auto &text, const std::string &path)
   {
      for (const LawParameter &parameter : law.parameters)
      {
         CAPTURE(law.name, parameter.name);
         const auto said = [&](const std::string &value)
         { return CaseError(text(TableOf(law, parameter.name, value))); };
         const std::string start = "case.toml:8:";
         const std::string key = ": " + path + "." + parameter.name + ": ";
         if (!parameter.standard)
         {
            CHECK_THAT(said(""),
                       Contains("this is missing (" + parameter.noun + ")"));
         }
         CHECK_THAT(
            said("\"x\""),
            Contains(key + "found the string \"x\"; expected a number"));
         if (!parameter.range.Text().empty())
         {
            const std::string text_of_error = said("-1e9");
            CHECK_THAT(text_of_error, Contains(key + parameter.noun +
                                               " is -1e+09; it must be " +
                                               parameter.range.Text()));
            CHECK_THAT(text_of_error, Catch::StartsWith("case.toml:"));
         }
         parameters++;
      }
      for (const LawVector &vector : law.vectors)
      {
         CAPTURE(law.name, vector.name);
         const auto said = [&](const std::string &value)
         { return CaseError(text(TableOf(law, vector.name, value))); };
         const std::string key = ": " + path + "." + vector.name + ": ";
         if (!vector.standard)
         {
            CHECK_THAT(said(""),
                       Contains("this is missing (" + vector.noun + ")"));
         }
         CHECK_THAT(said("2"), Contains(key + "found the integer 2"));
         if (!vector.range.Text().empty())
         {
            CHECK_THAT(said("[2, 2, -2]"),
                       Contains(key + vector.noun +
                                " is [2, 2, -2]; each number must be " +
                                vector.range.Text()));
         }
         parameters++;
      }
   };
   for (const auto &entry : SolidLaws().Entries())
   {
      const LawDescription &law = entry.description;
      const std::string path =
         NeedsGround(law) ? "material.0.solid.solids.1" : "material.0.solid";
      check(
         law,
         [&](const std::string &table)
         { return Text(Deformed(law), SolidTable(law, table), constant); },
         path);
   }
   for (const auto &entry : PermeabilityLaws().Entries())
   {
      const LawDescription &law = entry.description;
      const bool finite = Deformed(law) == "finite";
      check(
         law,
         [&](const std::string &table)
         { return Text(Deformed(law), finite ? ground : linear_solid, table); },
         "material.0.permeability");
   }
   CHECK(parameters > 40);
}

TEST_CASE("A law of another deformation is refused with the key to set",
          "[case]")
{
   int refused = 0;
   const auto check = [&](const LawDescription &law, const std::string &text,
                          const std::string &path)
   {
      if (!law.only_for)
      {
         return;
      }
      CAPTURE(law.name);
      const std::string said = CaseError(text);
      CHECK_THAT(said, Contains(": " + path + ".model: \"" + law.name +
                                "\" is a law of " + Deformed(law) +
                                " deformation; set physics.deformation = \"" +
                                Deformed(law) + "\" (case.toml:5:15: "));
      CHECK_THAT(said, Contains("or take one of \""));
      refused++;
   };
   for (const auto &entry : SolidLaws().Entries())
   {
      const LawDescription &law = entry.description;
      check(law, Text(Deformed(law, true), TableOf(law), constant),
            "material.0.solid");
   }
   for (const auto &entry : PermeabilityLaws().Entries())
   {
      const LawDescription &law = entry.description;
      check(law, Text(Deformed(law, true), linear_solid, TableOf(law)),
            "material.0.permeability");
   }
   CHECK(refused >= 17);
   // In a mixture, and where the key is not given.
   CHECK_THAT(CaseError(Text("finite",
                             "{model = \"mixture\", solids = [" + ground +
                                ", " + linear_solid + "]}",
                             constant)),
              Contains("material.0.solid.solids.1.model: \"isotropic\" is a "
                       "law of infinitesimal deformation"));
   std::string text = Text("finite", ground, constant);
   text.replace(text.find("deformation = \"finite\"\n"), 23, "");
   CHECK_THAT(CaseError(text), Contains("case.toml:7:18: material.0.solid."
                                        "model: \"neo_hookean\" is a law of "
                                        "finite deformation; set "
                                        "physics.deformation = \"finite\""));
   CHECK_THAT(CaseError(Text("finit", ground, constant)),
              Contains("case.toml:5:15: physics.deformation: found the string "
                       "\"finit\"; expected \"infinitesimal\" or \"finite\"; "
                       "did you mean \"finite\"?"));
}

TEST_CASE("Keys of other laws, and of none, are refused", "[case]")
{
   const auto said = [](const std::string &solid)
   { return CaseError(Text("finite", solid, constant)); };
   CHECK_THAT(
      said("{model = \"neo_hookean\", E = 1, nu = 0, beta = 2}"),
      Contains("material.0.solid.beta: this goes with "
               "\"ellipsoidal_fiber_distribution\", \"fiber_exp_pow\", ") &&
         Contains("\"holmes_mow\"") && Contains(", not with \"neo_hookean\""));
   CHECK_THAT(said("{model = \"neo_hookean\", E = 1, mu_ = 0}"),
              Contains("material.0.solid.mu_: there is no such key; there are: "
                       "model, E, nu"));
   CHECK_THAT(said("{model = \"neo_hokean\", E = 1, nu = 0}"),
              Contains("material.0.solid.model: found the string "
                       "\"neo_hokean\"") &&
                 Contains("did you mean \"neo_hookean\"?") &&
                 !Contains("solid.E"));
   CHECK_THAT(said("{model = \"mixture\"}"),
              Contains("material.0.solid.solids: this is missing"));
   CHECK_THAT(said("{model = \"mixture\", solids = []}"),
              Contains("material.0.solid.solids: there is no solid in the "
                       "mixture"));
   CHECK_THAT(said("{model = \"mixture\", solids = [3]}"),
              Contains("material.0.solid.solids: found a list of 1; expected "
                       "tables"));
   CHECK_THAT(said("{model = \"mixture\", solids = [{model = \"mixture\"}]}"),
              Contains("material.0.solid.solids.0.model: found the string "
                       "\"mixture\""));
   CHECK_THAT(said("{model = \"neo_hookean\", E = 1, nu = 0, solids = []}"),
              Contains("this goes with \"mixture\""));
   // Fibers alone make no body.
   NamedMesh mesh = OneBox();
   const CaseFile slack = ParseCase(
      Text("finite",
           "{model = \"mixture\", solids = [{model = \"fiber_nh\", mu = 2}]}",
           constant),
      "case.toml");
   CHECK_THROWS_WITH(CaseProblem(slack, mesh),
                     Contains("case.toml:6:1: material.0: nothing in the "
                              "mixture of solids resists compression"));
}

TEST_CASE("What a program sets is checked as well", "[case]")
{
   CaseFile setup = ParseCase(Text("finite", ground, constant), "case.toml");
   setup.places.clear();
   CHECK_NOTHROW(CheckCase(setup));
   SolidCase &solid = setup.materials[0].solid;
   solid = {"holmes_mow", {{"E", 0.5}, {"nu", 0.1}, {"Beta", 0.3}}};
   CHECK_THROWS_WITH(CheckCase(setup),
                     Contains("material.0.solid.beta: this is missing (the "
                              "exponent beta)") &&
                        Contains("material.0.solid.Beta: \"holmes_mow\" has no "
                                 "such parameter"));
   solid = {"homes_mow", {}};
   CHECK_THROWS_WITH(CheckCase(setup),
                     "material.0.solid.model: there is no \"homes_mow\"");
}

TEST_CASE("Overrides reach the parts of a mixture", "[case]")
{
   const CaseFile setup = ParseCase(
      Text("finite",
           "{model = \"mixture\", solids = [" + ground +
              ", {model = \"fiber_nh\", mu = 2}]}",
           constant),
      "case.toml",
      {"material.body.solid.solids.1.mu=3",
       "material.0.permeability={model = \"exponential\", value = 1e-3, M = "
       "2}"});
   CHECK(setup.materials[0].solid.solids[1].parameters.at("mu") == 3.0);
   CHECK(setup.materials[0].permeability.model == "exponential");
}

TEST_CASE("The list of keys has all laws", "[case]")
{
   std::ostringstream out;
   ListCaseKeys(out);
   const std::string text = out.str();
   for (const auto &entry : SolidLaws().Entries())
   {
      CHECK_THAT(text, Contains("\"" + entry.description.name + "\""));
      CHECK_THAT(text, Contains(entry.description.meaning));
   }
   for (const auto &entry : PermeabilityLaws().Entries())
   {
      CHECK_THAT(text, Contains(entry.description.meaning));
   }
   CHECK_THAT(text, Contains("\nphysics.deformation "));
   CHECK_THAT(text, Contains("\nmaterial.N.solid.solids "));
   CHECK_THAT(text, Contains("\nmaterial.N.permeability.k1A "));
   // A key that several laws share has one line.
   CHECK_THAT(text, Contains("Young's modulus; positive; for holmes_mow, "
                             "isotropic, neo_hookean, porous_neo_hookean, "
                             "saint_venant_kirchhoff\n"));
}

TEST_CASE("A program adds a law of its own", "[case]")
{
   SolidLaws().Add<Toy>();
   CHECK_THROWS_WITH(SolidLaws().Add<Toy>(),
                     "there is a law called \"toy\" already; give this one "
                     "another name");
   CHECK_THAT(CaseError(Text("finite", "{model = \"toy\", c = -1}", constant)),
              Contains("the modulus c is -1; it must be positive"));
   NamedMesh mesh = OneBox();
   CaseProblem problem(
      ParseCase(Text("finite", "{model = \"toy\", c = 0.5}", constant),
                "case.toml"),
      mesh);
   CHECK(problem.Get().Materials().Get(1).solid->ShearModulus() == 0.5);
   const CartesianFrame frame(Point3{{1.0, 0.0, 0.0}});
   CHECK_THROWS_WITH(SolidLaws().Make("toy", {{}, frame, 0.2, {}}),
                     "c of \"toy\" is missing (the modulus c)");
   CHECK_THROWS_WITH(SolidLaws().Make("toi", {{}, frame, 0.2, {}}),
                     "there is no law called \"toi\"");
}
