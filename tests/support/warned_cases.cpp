#include "support/warned_cases.hpp"
#include "support/round_meshes.hpp"
#include "synovia/checks/case_warnings.hpp"
#include "synovia/checks/contact_check.hpp"

#include <catch2/catch.hpp>

#include <algorithm>

namespace synovia
{

using namespace mfem;
using Catch::Matchers::Contains;

const std::string pressed_layer = R"([mesh]
file = "boxes.msh"
[[material]]
regions = ["lower"]
solid = {E = 0.5, nu = 0.1}
permeability = {value = 4e-3}
[[material]]
regions = ["upper"]
solid = {E = 500, nu = 0.1}
permeability = {value = 4}
[[boundary]]
surfaces = ["lower_z0"]
displacement = [0, 0, 0]
[[boundary]]
surfaces = ["lower_x0", "upper_x0"]
displacement = [0, "free", "free"]
[[boundary]]
surfaces = ["lower_y0", "upper_y0"]
displacement = ["free", 0, "free"]
[[boundary]]
surfaces = ["upper_z1"]
displacement = ["free", "free", {times = [0, 500], values = [0, -0.2]}]
pressure = 0
[[contact]]
source = ["upper_z0"]
destination = ["lower_z1"]
[time]
end = 1500
step = 25
)";

std::string PressedByForce()
{
   return Replaced(
      pressed_layer,
      R"(displacement = ["free", "free", {times = [0, 500], values = [0, -0.2]}])",
      R"(displacement = [0, 0, "free"]
force = {direction = [0, 0, -1], curve = {times = [0, 500], values = [0, 0.2]}})");
}

BoxOptions LayerOptions()
{
   BoxOptions layer;
   layer.nx = 5;
   layer.ny = 5;
   layer.nz = 2;
   layer.size_x = 10.0;
   layer.size_y = 10.0;
   layer.size_z = 2.0;
   return layer;
}

BoxOptions BlockOptions()
{
   BoxOptions block;
   block.nx = 1;
   block.ny = 1;
   block.nz = 1;
   block.size_x = 2.0;
   block.size_y = 2.0;
   block.size_z = 2.0;
   return block;
}

void LiftBlock(real_t height, Mesh &mesh)
{
   const BoxOptions layer = LayerOptions();
   const int below = (layer.nx + 1) * (layer.ny + 1) * (layer.nz + 1);
   for (int i = below; i < mesh.GetNV(); i++)
   {
      mesh.GetVertex(i)[2] += height;
   }
}

NamedMesh PressedLayer(real_t scale)
{
   Mesh mesh = MakeStackMesh(LayerOptions(), BlockOptions());
   for (int i = 0; i < mesh.GetNV(); i++)
   {
      for (int d = 0; d < 3; d++)
      {
         mesh.GetVertex(i)[d] *= scale;
      }
   }
   return DistributeStack(mesh, MPI_COMM_WORLD);
}

const std::string pressed_disc = R"([mesh]
file = "disc.msh"
[[material]]
regions = ["body"]
solid = {E = 0.5, nu = 0.1}
permeability = {value = 4e-3}
[[boundary]]
surfaces = ["z0"]
displacement = ["free", 0, 0]
[[boundary]]
surfaces = ["z1"]
displacement = ["free", "free", {times = [0, 500], values = [0, -0.02]}]
[[boundary]]
surfaces = ["x0"]
displacement = [0, "free", "free"]
[[boundary]]
surfaces = ["side"]
pressure = 0
[time]
end = 1500
step = 25
)";

NamedMesh PressedDisc()
{
   RoundOptions options;
   options.radius = 1.5;
   options.height = 0.25;
   return MakeQuarterCylinder(options);
}

std::string Replaced(std::string text, const std::string &from,
                     const std::string &to)
{
   const size_t at = text.find(from);
   REQUIRE(at != std::string::npos);
   return text.replace(at, from.size(), to);
}

std::string Without(std::string text, const std::vector<std::string> &parts)
{
   for (const std::string &part : parts)
   {
      text = Replaced(text, part, "");
   }
   return text;
}

std::string Joined(const std::vector<std::string> &lines)
{
   std::string text;
   for (const std::string &line : lines)
   {
      text += line + "\n";
   }
   return text;
}

std::string OnAllRanks(const std::string &text)
{
   int length = static_cast<int>(text.size());
   MPI_Bcast(&length, 1, MPI_INT, 0, MPI_COMM_WORLD);
   std::string first = text;
   first.resize(length);
   MPI_Bcast(&first[0], length, MPI_CHAR, 0, MPI_COMM_WORLD);
   CHECK(text == first);
   return text;
}

std::string WarningsOf(const std::string &text, NamedMesh &mesh)
{
   const CaseFile setup = ParseCase(text, "case.toml");
   CaseProblem problem(setup, mesh);
   return OnAllRanks(
      Joined(FindWarnings(setup, problem, CheckContact(setup, problem))));
}

std::string WarningsOf(const std::string &text)
{
   NamedMesh mesh = PressedLayer();
   return WarningsOf(text, mesh);
}

void CheckOneWarning(const std::string &warnings,
                     const std::vector<std::string> &texts)
{
   CHECK(std::count(warnings.begin(), warnings.end(), '\n') == 1);
   for (const std::string &text : texts)
   {
      CHECK_THAT(warnings, Contains(text));
   }
}

} // namespace synovia
