// ranks: 1 2 3

#include "synovia/checks/case_warnings.hpp"
#include "support/warned_cases.hpp"
#include "synovia/checks/contact_hints.hpp"
#include "synovia/runs/problem_report.hpp"

#include <catch2/catch.hpp>

#include <sstream>

using namespace mfem;
using namespace synovia;
using Catch::Matchers::Contains;

namespace
{
std::string HintsOf(const std::string &text, NamedMesh &mesh)
{
   const CaseFile setup = ParseCase(text, "case.toml");
   CaseProblem problem(setup, mesh);
   return OnAllRanks(Joined(ProblemReport(setup, problem).Hints()));
}
} // namespace

TEST_CASE("A case that is right draws no warning", "[warnings]")
{
   CHECK(WarningsOf(pressed_layer) == "");
   CHECK(WarningsOf(PressedByForce()) == "");
   // A stand-in for a rigid block, a quick test and a slow one.
   CHECK(WarningsOf(Replaced(Replaced(pressed_layer, "E = 500", "E = 5e5"),
                             "value = 4}", "value = 4e3}")) == "");
   CHECK(WarningsOf(
            Replaced(Replaced(Replaced(pressed_layer, "[0, 500]", "[0, 0.1]"),
                              "end = 1500", "end = 0.5"),
                     "step = 25", "step = 0.01")) == "");
   CHECK(WarningsOf(
            Replaced(Replaced(Replaced(pressed_layer, "[0, 500]", "[0, 1e6]"),
                              "end = 1500", "end = 1e6"),
                     "step = 25", "step = 1e5")) == "");
}

TEST_CASE("Wrong units are called by their name", "[warnings]")
{
   struct Mistake
   {
      std::string from;
      std::string to;
      std::vector<std::string> texts;
   };
   const std::vector<Mistake> mistakes = {
      {"value = 4e-3}",
       "value = 4e-15}",
       {"case.toml:6:", "material.0.permeability.value",
        "permeability of \"lower\" looks 1e+12 times too small",
        "hardly any fluid moves"}},
      {"E = 0.5,",
       "E = 5e5,",
       {"case.toml:5:", "material.0.solid",
        "stiffness of \"lower\" looks 1e+06 times too large"}},
      {"E = 500,",
       "E = 5e8,",
       {"case.toml:9:", "material.1.solid",
        "stiffness of \"upper\" looks 1e+06 times too large",
        "1e+09 times as stiff as \"lower\""}},
      {"value = 4}",
       "value = 4e12}",
       {"case.toml:10:", "material.1.permeability.value",
        "permeability of \"upper\" looks 1e+12 times too large"}},
      {"-0.2]",
       "-200]",
       {"case.toml:22:", "boundary.3.displacement",
        "the displacement looks 1000 times too large",
        "a displacement of 200 presses \"upper\"", "4 thick"}},
   };
   for (const Mistake &mistake : mistakes)
   {
      INFO(mistake.to);
      CheckOneWarning(
         WarningsOf(Replaced(pressed_layer, mistake.from, mistake.to)),
         mistake.texts);
   }
}

TEST_CASE("Wrong units of all materials are told from the mesh's", "[warnings]")
{
   const auto both = [](const std::string &text, const std::string &first,
                        const std::string &second, const std::string &key)
   {
      return key == "E"
                ? Replaced(Replaced(text, "E = 0.5,", "E = " + first),
                           "E = 500,", "E = " + second)
                : Replaced(Replaced(text, "value = 4e-3", "value = " + first),
                           "value = 4}", "value = " + second);
   };
   for (const std::string &text : {pressed_layer, PressedByForce()})
   {
      CheckOneWarning(WarningsOf(both(text, "4e-15", "4e-12}", "kappa")),
                      {"all permeabilities look 1e+12 times too small"});
      CheckOneWarning(WarningsOf(both(text, "4e9", "4e12}", "kappa")),
                      {"all permeabilities look 1e+12 times too large",
                       "hardly any fluid pressure"});
      CheckOneWarning(WarningsOf(both(text, "5e5,", "5e8,", "E")),
                      {"all stiffnesses look 1e+06 times too large"});
      CheckOneWarning(WarningsOf(both(text, "5e-7,", "5e-4,", "E")),
                      {"all stiffnesses look", "1e+06 times too small"});

      NamedMesh meters = PressedLayer(1e-3);
      CheckOneWarning(WarningsOf(text, meters),
                      {"case.toml:2:", "mesh.file",
                       "the mesh looks 1000 times too small",
                       "mesh.scale = 1000"});
      NamedMesh millimeters = PressedLayer(1e3);
      CheckOneWarning(
         WarningsOf(text, millimeters),
         {"the mesh looks 1000 times too large", "mesh.scale = 0.001"});
   }
}

TEST_CASE("A drained solid that is nearly incompressible", "[warnings]")
{
   CheckOneWarning(
      WarningsOf(Replaced(pressed_layer, "nu = 0.1", "nu = 0.499")),
      {"case.toml:5:", "material.0.solid.nu", "0.499",
       "nearly incompressible"});
   CHECK(WarningsOf(Replaced(pressed_layer, "nu = 0.1", "nu = 0.49")) == "");
}

TEST_CASE("A solid that order 1 makes too stiff", "[warnings]")
{
   const std::string text =
      "space.order = 1\n" + Replaced(pressed_layer, "nu = 0.1", "nu = 0.46");
   CheckOneWarning(WarningsOf(text),
                   {"case.toml:6:", "material.0.solid", "nu = 0.46",
                    "mean_dilatation = true", "space.order = 2"});
   CHECK(WarningsOf(
            Replaced(text, "regions = [\"lower\"]",
                     "regions = [\"lower\"]\nmean_dilatation = true")) == "");
}

TEST_CASE("A plane of symmetry that was forgotten", "[warnings]")
{
   const std::string without_y = Replaced(pressed_layer, R"([[boundary]]
surfaces = ["lower_y0", "upper_y0"]
displacement = ["free", 0, "free"]
)",
                                          "");
   const std::string warnings = WarningsOf(without_y);
   CHECK_THAT(warnings, Contains("\"lower_y0\" of \"lower\" in the plane y = 0 "
                                 "(area 20, free of traction and sealed)"));
   CHECK_THAT(warnings, Contains("\"upper\" ends there too"));
   CHECK_THAT(warnings, Contains("displacement = [\"free\", 0, \"free\"]"));
   CHECK_THAT(warnings, Contains("\"upper_y0\" of \"upper\" in the plane"));
   CHECK_THAT(warnings, Contains("only contact holds \"upper\" along y"));

   const std::string half = WarningsOf(
      Replaced(pressed_layer, "\"lower_y0\", \"upper_y0\"", "\"lower_y0\""));
   CHECK_THAT(half, Contains("\"upper_y0\" of \"upper\" in the plane y = 0"));
   CHECK_THAT(half, Contains("\"lower\" has a plane of symmetry there"));
}

TEST_CASE("Free sides are not planes of symmetry", "[warnings]")
{
   // Two blocks of one width, free on all sides.
   BoxOptions block = BlockOptions();
   block.nz = 2;
   NamedMesh mesh = MakeStack(block, block);
   std::string text = pressed_layer;
   for (const char *surfaces :
        {"\"lower_x0\", \"upper_x0\"", "\"lower_y0\", \"upper_y0\""})
   {
      text = Replaced(text, surfaces, "\"upper_z1\"");
   }
   CHECK(WarningsOf(text, mesh) == "");
}

TEST_CASE("A quarter of a disc that lacks one plane of symmetry", "[warnings]")
{
   NamedMesh mesh = PressedDisc();
   CheckOneWarning(WarningsOf(pressed_disc, mesh),
                   {"\"y0\" of \"body\" in the plane y = 0", "area 0.375",
                    "another plane of symmetry"});
   const std::string whole = pressed_disc + R"([[boundary]]
surfaces = ["y0"]
displacement = ["free", 0, "free"]
)";
   CHECK(WarningsOf(whole, mesh) == "");

   // It drains at its side, 1.5 from the axis.
   const CaseFile setup = ParseCase(whole, "case.toml");
   CaseProblem problem(setup, mesh);
   const ProblemReport report(setup, problem);
   REQUIRE(report.Regions().size() == 1);
   CHECK(report.Regions()[0].thickness == Approx(0.25));
   CHECK(report.Regions()[0].drainage_length == Approx(1.5).epsilon(0.01));
}

TEST_CASE("Layers are measured through and to where they drain", "[warnings]")
{
   NamedMesh mesh = PressedLayer();
   for (const std::string sides : {"", R"([[boundary]]
surfaces = ["lower_x1", "lower_y1"]
pressure = 0
)"})
   {
      const CaseFile setup = ParseCase(pressed_layer + sides, "case.toml");
      CaseProblem problem(setup, mesh);
      const ProblemReport report(setup, problem);
      REQUIRE(report.Regions().size() == 2);
      const RegionMeasures &layer = report.Regions()[0];
      CHECK(layer.name == "lower");
      CHECK(layer.thickness == Approx(2.0));
      CHECK(layer.drainage_length == Approx(2.0));
      const real_t modulus = layer.aggregate_modulus;
      CHECK(layer.gel_time == Approx(4.0 / (modulus * 4e-3)));
      // The block drains at its top and in the contact.
      CHECK(report.Regions()[1].thickness == Approx(2.0));
      CHECK(report.Regions()[1].drainage_length == Approx(1.0));

      std::ostringstream text;
      report.Write(text);
      CHECK_THAT(text.str(), Contains("drainage length"));
      CHECK_THAT(text.str(),
                 Contains(sides.empty() ? "traction-free, sealed"
                                        : "traction-free, pressure"));
      OnAllRanks(text.str());
   }
}

TEST_CASE("The better destination is advised", "[warnings]")
{
   // The layer has the smaller modulus, and the finer mesh or the coarser.
   NamedMesh mesh = PressedLayer();
   CHECK(HintsOf(pressed_layer, mesh) == "");
   const std::string swapped =
      Replaced(Replaced(pressed_layer, "destination = [\"lower_z1\"]",
                        "destination = [\"upper_z0\"]"),
               "source = [\"upper_z0\"]", "source = [\"lower_z1\"]");
   CheckOneWarning(HintsOf(swapped, mesh),
                   {"case.toml:26:", "contact.0.destination",
                    "\"lower_z1\" would be the better destination",
                    "mean edges 2 now and 2 then"});
   // Neither softer nor finer by much.
   CHECK(HintsOf(Replaced(swapped, "E = 500", "E = 0.6"), mesh) == "");
   // Softer, but much coarser: neither is clearly better.
   BoxOptions fine = BlockOptions();
   fine.nx = 4;
   fine.ny = 4;
   NamedMesh finer = MakeStack(LayerOptions(), fine);
   CHECK(HintsOf(pressed_layer, finer) == "");
   CHECK(HintsOf(swapped, finer) == "");
}

namespace
{
constexpr real_t radius = 4.0;
constexpr real_t lift = 0.01;

void MakeRound(const Vector &x, Vector &y)
{
   y = x;
   if (x[2] > 2.0 + 0.5 * lift)
   {
      y[2] += (x[0] * x[0] + x[1] * x[1]) / (2.0 * radius);
   }
}

/// The block has a round bottom, of four elements along an edge.
NamedMesh RoundBlock(int order)
{
   BoxOptions block = BlockOptions();
   block.nx = 4;
   block.ny = 4;
   Mesh mesh = MakeStackMesh(LayerOptions(), block);
   LiftBlock(lift, mesh);
   mesh.SetCurvature(order);
   mesh.Transform(MakeRound);
   return DistributeStack(mesh, MPI_COMM_WORLD);
}
} // namespace

TEST_CASE("Flat faces of round contact surfaces", "[warnings]")
{
   NamedMesh straight = RoundBlock(1);
   CheckOneWarning(HintsOf(pressed_layer, straight),
                   {"case.toml:25:", "contact.0.source",
                    "the faces of \"upper_z0\" are flat", "h^2/(8 R)",
                    "second order"});
   const CaseFile setup = ParseCase(pressed_layer, "case.toml");
   CaseProblem problem(setup, straight);
   const std::vector<ContactSides> sides =
      MeasureContactSides(setup, problem, CheckContact(setup, problem));
   REQUIRE(sides.size() == 1);
   CHECK(sides[0].source.edge == Approx(0.5).epsilon(0.05));
   CHECK(sides[0].source.Radius() == Approx(radius).epsilon(0.2));
   CHECK(sides[0].source.sagitta == Approx(0.25 / (8.0 * radius)).epsilon(0.2));
   CHECK(sides[0].destination.sagitta < 1e-12);

   NamedMesh curved = RoundBlock(2);
   CHECK(HintsOf(pressed_layer, curved) == "");
}

TEST_CASE("Sharp edges of contact surfaces are not round", "[warnings]")
{
   // The block's sides belong to its surface.
   const std::string text =
      Replaced(Replaced(pressed_layer, "source = [\"upper_z0\"]",
                        "source = [\"upper_z0\", \"upper_x1\"]"),
               "E = 500", "E = 0.5");
   NamedMesh mesh = PressedLayer();
   CHECK(HintsOf(text, mesh) == "");
}
