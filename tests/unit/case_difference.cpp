// ranks: 1
//
// What differs between two cases, and what a resumed run may have changed.

#include "synovia/cases/case_difference.hpp"

#include <catch2/catch.hpp>

#include <algorithm>

using namespace synovia;

namespace
{
CaseFile SomeCase()
{
   return ParseCase(R"(
      title = "Column"
      [mesh]
      file = "column.msh"
      [[material]]
      regions = ["column"]
      solid = {E = 0.5, nu = 0.1}
      permeability = {value = 4e-3}
      [[boundary]]
      surfaces = ["top"]
      displacement = ["free", "free", {times = [0, 10], values = [0, -1]}]
      [[contact]]
      source = ["a"]
      destination = ["b"]
      [time]
      end = 10
      step = 1
   )",
                    "some.toml");
}

std::vector<std::string> Paths(const std::vector<CaseChange> &changes)
{
   std::vector<std::string> paths;
   for (const CaseChange &change : changes)
   {
      paths.push_back(change.path);
   }
   return paths;
}
} // namespace

TEST_CASE("Equal cases have no differences, wherever mesh and results are")
{
   const CaseFile before = SomeCase();
   CaseFile after = before;
   CHECK(FindChanges(before, after).empty());
   after.mesh.file = "/elsewhere/column.msh";
   after.output.directory = "/elsewhere/out";
   CHECK(FindChanges(before, after).empty());
}

TEST_CASE("Changed keys are found with their values, in both directions")
{
   const CaseFile before = SomeCase();
   CaseFile after = before;
   after.materials[0].solid.parameters["E"] = 0.75;
   after.boundaries[0].displacement[2] = LoadCurve(-2.0);
   after.boundaries[0].pressure = LoadCurve(0.0);
   after.contacts[0].options.penalty = 3.0;
   after.boundaries.push_back(after.boundaries[0]);
   const std::vector<CaseChange> changes = FindChanges(before, after);
   std::vector<std::string> paths = Paths(changes);
   REQUIRE(paths.size() > 7);
   CHECK(std::all_of(paths.begin() + 7, paths.end(),
                     [](const std::string &path)
                     { return path.rfind("boundary.1.", 0) == 0; }));
   paths.resize(7);
   CHECK(paths == std::vector<std::string>{
                     "material.0.solid.E", "boundary.0.displacement",
                     "contact.0.penalty", "boundary.0.pressure",
                     "boundary.1.surfaces", "boundary.1.displacement",
                     "boundary.1.pressure"});
   for (const CaseChange &change : changes)
   {
      CAPTURE(change.path);
      CHECK_FALSE(MayChange(change));
   }
   CHECK(ToText(changes[0]) == "material.0.solid.E: was 0.5, is 0.75");
   CHECK(ToText(changes[1]) ==
         "boundary.0.displacement: was [\"free\", \"free\", {times = [0.0, "
         "10.0], values = [0.0, -1.0]}], is [\"free\", \"free\", -2.0]");
   CHECK(ToText(changes[2]) == "contact.0.penalty: was \"auto\", is 3.0");
   CHECK(ToText(changes[3]) == "boundary.0.pressure: was not set, is 0.0");
   CHECK(
      ToText(changes[0], after.places).rfind("some.toml:7:20: material.0", 0) ==
      0);
   const std::vector<CaseChange> back = FindChanges(after, before);
   CHECK(back.size() == changes.size());
   CHECK(std::any_of(back.begin(), back.end(),
                     [](const CaseChange &change) {
                        return ToText(change) ==
                               "boundary.0.pressure: was 0.0, is not set";
                     }));
}

TEST_CASE("Title, time, solver and output may change in a resumed run")
{
   const CaseFile before = SomeCase();
   CaseFile after = before;
   after.title = "Another";
   after.time.end = 20.0;
   after.time.step = 0.5;
   after.time.adaptive = true;
   after.solver.max_newton = 7;
   after.solver.linear.method = LinearMethod::direct;
   after.output.fields_every = 3;
   after.output.lines.resize(1);
   const std::vector<CaseChange> changes = FindChanges(before, after);
   CHECK(changes.size() >= 8);
   CHECK(std::all_of(changes.begin(), changes.end(), MayChange));
   after.space.order = 3;
   const std::vector<CaseChange> more = FindChanges(before, after);
   CHECK(std::count_if(more.begin(), more.end(), MayChange) ==
         static_cast<int>(changes.size()));
   CHECK(more.size() == changes.size() + 1);
}

TEST_CASE("Of many changes the first ones are listed")
{
   const CaseFile before = SomeCase();
   CaseFile after = before;
   after.materials.resize(4, before.materials[0]);
   const std::string text = ToText(FindChanges(before, after), after.places);
   CHECK(std::count(text.begin(), text.end(), '\n') == 10);
   CHECK(text.find("more keys") != std::string::npos);
}
