// ranks: 1 2 3
//
// Bodies that supports and springs leave free to move or to turn, and that
// contact doesn't hold.

#include "support/warned_cases.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <regex>

using namespace mfem;
using namespace synovia;
using Catch::Matchers::Contains;

TEST_CASE("Bodies that contact alone doesn't hold", "[warnings]")
{
   const std::string floating = Replaced(pressed_layer, R"([[boundary]]
surfaces = ["lower_z0"]
displacement = [0, 0, 0]
)",
                                         "");
   CheckOneWarning(
      WarningsOf(floating),
      {"only contact holds \"lower\" along z, from one side", "case.toml"});
   CHECK_THAT(WarningsOf(Replaced(pressed_layer, "\"lower_x0\", \"upper_x0\"",
                                  "\"lower_x0\"")),
              Contains("only contact holds \"upper\" along x, which can't"));
   // A force presses it on what it touches.
   CHECK(WarningsOf(PressedByForce()) == "");

   Mesh apart = MakeStackMesh(LayerOptions(), BlockOptions());
   LiftBlock(0.5, apart);
   NamedMesh mesh = DistributeStack(apart, MPI_COMM_WORLD);
   CHECK(WarningsOf(PressedByForce(), mesh) == "");
   const std::string with_traction = Replaced(
      PressedByForce(),
      "force = {direction = [0, 0, -1], curve = ", "traction = [0, 0, ");
   CheckOneWarning(
      WarningsOf(Replaced(with_traction, "[0, 0.2]}}", "[0, -0.05]}]"), mesh),
      {"only contact holds \"upper\" along z, which it doesn't "
       "touch yet: the least gap is 0.5"});
}

namespace
{
const std::string planes_of_symmetry = R"([[boundary]]
surfaces = ["lower_x0", "upper_x0"]
displacement = [0, "free", "free"]
[[boundary]]
surfaces = ["lower_y0", "upper_y0"]
displacement = ["free", 0, "free"]
)";

const std::string pressed_top = R"([[boundary]]
surfaces = ["upper_z1"]
displacement = ["free", "free", {times = [0, 500], values = [0, -0.2]}]
pressure = 0
)";

void Incline(const Vector &x, Vector &y)
{
   const real_t c = std::sqrt(0.75);
   y[0] = c * x[0] + 0.5 * x[2];
   y[1] = x[1];
   y[2] = -0.5 * x[0] + c * x[2];
}

constexpr real_t sphere = 6.0;

// A sphere through the lower corner on the z axis, center above.
void MakeSpherical(const Vector &x, Vector &y)
{
   y = x;
   if (x[2] > 2.05)
   {
      y[2] += sphere - std::sqrt(sphere * sphere - x[0] * x[0] - x[1] * x[1]);
   }
}
} // namespace

TEST_CASE("Bodies that slide or turn on what they touch", "[warnings]")
{
   CHECK_THAT(WarningsOf(Without(pressed_layer, {planes_of_symmetry})),
              Contains("case.toml:11:1: boundary: only contact holds \"upper\" "
                       "along x, along y and about z through (1, 1, 2), which "
                       "can't, as there is no friction; prescribe "
                       "displacements on one of its surfaces, or add springs"));
   // Springs on its top hold it against that.
   CHECK(WarningsOf(Without(pressed_layer, {planes_of_symmetry}) +
                    "[[boundary]]\nsurfaces = [\"upper_z1\"]\n"
                    "spring = {stiffness = 1e-3}\n")
            .find("only contact") == std::string::npos);

   Mesh tilted = MakeStackMesh(LayerOptions(), BlockOptions());
   tilted.Transform(Incline);
   NamedMesh mesh = DistributeStack(tilted, MPI_COMM_WORLD);
   const std::string on_slope =
      WarningsOf(Replaced(Without(pressed_layer, {pressed_top}),
                          "\"lower_x0\", \"upper_x0\"", "\"lower_x0\""),
                 mesh);
   CHECK_THAT(on_slope, Contains("only contact holds \"upper\" along "
                                 "(0.866025, 0, -0.5), which can't"));
   CHECK_THAT(on_slope, Contains("only contact holds \"upper\" along z, "
                                 "from one side"));
   CHECK_THAT(on_slope, !Contains("about"));
}

TEST_CASE("A ball turns about its center", "[warnings]")
{
   BoxOptions block = BlockOptions();
   block.nx = block.ny = 8;
   Mesh ball = MakeStackMesh(LayerOptions(), block);
   LiftBlock(0.1, ball);
   ball.Transform(MakeSpherical);
   NamedMesh mesh = DistributeStack(ball, MPI_COMM_WORLD);
   const std::string warnings = WarningsOf(
      Without(pressed_layer, {planes_of_symmetry, pressed_top}), mesh);
   INFO(warnings);
   // The third one's axis goes from the surface's center to the ball's.
   const std::regex turns(
      "only contact holds \"upper\" about y through "
      "\\(([^,]+), 1, ([^,]+)\\), about x through \\(1, ([^,]+), ([^,]+)\\) "
      "and about \\(-0.168[0-9]*, -0.168[0-9]*, 0.971[0-9]*\\) through [^;]*, "
      "which can't, as there is no friction;");
   std::smatch found;
   REQUIRE(std::regex_search(warnings, found, turns));
   for (const int axis : {0, 1})
   {
      CHECK(std::abs(std::stod(found[1 + 2 * axis])) < 0.1);
      CHECK(std::stod(found[2 + 2 * axis]) ==
            Approx(2.1 + sphere).epsilon(0.05));
   }
}

TEST_CASE("Bodies that nothing keeps from turning", "[warnings]")
{
   // Each displacement is held in a plane through the axis.
   const std::string hinged =
      Replaced(Replaced(Replaced(pressed_disc, "[\"free\", 0, 0]",
                                 "[\"free\", \"free\", 0]"),
                        "[\"x0\"]\ndisplacement = [0, \"free\"",
                        "[\"x0\"]\ndisplacement = [\"free\", 0"),
               "surfaces = [\"side\"]\n",
               "surfaces = [\"y0\"]\ndisplacement = [0, \"free\", \"free\"]\n"
               "[[boundary]]\nsurfaces = [\"side\"]\n");
   NamedMesh mesh = PressedDisc();
   CHECK_THAT(
      WarningsOf(hinged, mesh),
      Contains("case.toml:7:1: boundary: nothing holds \"body\" about z "
               "through (0, 0, 0.125); prescribe that displacement"));
   CHECK_THAT(WarningsOf(Replaced(hinged,
                                  "[\"z0\"]\ndisplacement = "
                                  "[\"free\", \"free\"",
                                  "[\"z0\"]\ndisplacement = [\"free\", 0"),
                         mesh),
              !Contains("nothing holds"));
}
