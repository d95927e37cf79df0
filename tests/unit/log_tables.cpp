// ranks: 1 2
//
// Logs of a column that is pressed: what nodes and elements have agrees with
// the load, with each other, and with what the strain says; a run that goes on
// continues them.

#include "synovia/io/log_tables.hpp"
#include "support/feb_text.hpp"
#include "support/temporary_directory.hpp"
#include "synovia/feb/feb_import.hpp"
#include "synovia/general/error.hpp"
#include "synovia/runs/simulation.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>

using namespace mfem;
using namespace synovia;
using Catch::Matchers::Contains;

namespace
{
struct Block
{
   int step = 0;
   real_t time = 0.0;
   std::string data;
   std::map<int, std::vector<real_t>> rows;
};

std::vector<Block> ReadLog(const std::string &path)
{
   std::vector<Block> blocks;
   std::istringstream text(ReadText(path));
   for (std::string line; std::getline(text, line);)
   {
      const std::string value =
         line[0] == '*' ? line.substr(line.find('=') + 2) : "";
      if (line.rfind("*Step", 0) == 0)
      {
         blocks.emplace_back();
         blocks.back().step = std::stoi(value);
      }
      else if (line.rfind("*Time", 0) == 0)
      {
         blocks.back().time = std::stod(value);
      }
      else if (line.rfind("*Data", 0) == 0)
      {
         blocks.back().data = value;
      }
      else
      {
         std::istringstream words(line);
         int number = 0;
         words >> number;
         CHECK(blocks.back().rows.count(number) == 0);
         for (real_t x; words >> x;)
         {
            blocks.back().rows[number].push_back(x);
         }
      }
   }
   return blocks;
}

LogDefinition Log(const std::string &file, LogSubject of,
                  const std::vector<std::string> &data)
{
   LogDefinition log;
   log.file = file;
   log.of = of;
   log.data = data;
   return log;
}

/// Two elements of edge 1 above each other, pressed by up to 0.5.
CaseFile PressedColumn(const TemporaryDirectory &directory, bool finite)
{
   const FebImport import = ImportFeb(FebColumn(), "column.feb");
   CaseFile setup(import.setup);
   setup.mesh.file = directory.Write("column.msh", import.mesh);
   setup.output.directory = directory / "out";
   setup.output.fields_every = 0;
   if (!finite)
   {
      setup.space.deformation = Deformation::infinitesimal;
      setup.materials[0].solid = {"isotropic", {{"E", 2.0}, {"nu", 0.1}}};
   }
   setup.materials[0].permeability = {"constant", {{"value", 0.01}}};
   return setup;
}

constexpr real_t round_off = 1e-7;
} // namespace

TEST_CASE("Logs have what FEBio's have")
{
   const bool finite = GENERATE(false, true);
   CAPTURE(finite);
   const TemporaryDirectory directory;
   CaseFile setup = PressedColumn(directory, finite);
   setup.output.logs = {Log("nodes.txt", LogSubject::nodes,
                            {"x", "y", "z", "uz", "Rx", "Ry", "Rz", "p"}),
                        Log("elements.txt", LogSubject::elements,
                            {"z", "sz", "sx", "s1", "s3", "Ez", "E3", "Fzz",
                             "Fxx", "J", "p", "wz", "wx"}),
                        Log("top.txt", LogSubject::nodes, {"p"})};
   setup.output.logs[2].surfaces = {"top"};
   Simulation simulation(setup, MPI_COMM_WORLD);
   REQUIRE(simulation.Run() == 0);
   const std::vector<Block> nodes = ReadLog(directory / "out/logs/nodes.txt");
   const std::vector<Block> elements =
      ReadLog(directory / "out/logs/elements.txt");
   REQUIRE(nodes.size() == 10);
   REQUIRE(elements.size() == 10);
   CHECK(nodes[3].step == 4);
   CHECK(nodes[3].time == Approx(2.0));
   CHECK(elements[3].data == "z;sz;sx;s1;s3;Ez;E3;Fzz;Fxx;J;p;wz;wx");
   CHECK(ReadLog(directory / "out/logs/top.txt")[0].rows.size() == 4);

   // In the first step, while the load grows.
   const auto &at = nodes[0].rows;
   REQUIRE(at.size() == 12);
   const real_t load = 0.5;
   CHECK(at.at(11)[0] == Approx(1.0));
   CHECK(at.at(11)[1] == Approx(1.0));
   CHECK(at.at(11)[2] == Approx(2.0 + at.at(11)[3]));
   real_t borne = 0.0;
   for (int n = 1; n <= 4; n++)
   {
      borne += at.at(n)[6];
   }
   // The body presses its support down.
   CHECK(borne == Approx(-load).epsilon(round_off));
   // Inside nothing acts on it, at the top the load does.
   CHECK(std::abs(at.at(5)[6]) < round_off);
   real_t on_load = 0.0;
   for (int n = 9; n <= 12; n++)
   {
      on_load += at.at(n)[6];
   }
   CHECK(on_load == Approx(load).epsilon(round_off));
   // And the walls outwards, by half the stress of both sides.
   const auto &lower = elements[0].rows.at(1);
   const auto &upper = elements[0].rows.at(2);
   CHECK(at.at(1)[4] < 0.0);
   CHECK(at.at(2)[4] > 0.0);
   for (const auto *element : {&lower, &upper})
   {
      CHECK((*element)[1] == Approx(-load).epsilon(round_off));
      CHECK((*element)[3] ==
            Approx(std::max((*element)[1], (*element)[2])).epsilon(round_off));
      CHECK((*element)[4] ==
            Approx(std::min((*element)[1], (*element)[2])).epsilon(round_off));
      CHECK((*element)[8] == Approx(1.0));
      CHECK(std::abs((*element)[12]) < 1e-12);
   }
   const real_t stretch = 1.0 + at.at(9)[3] - at.at(5)[3];
   CHECK(stretch < 0.99);
   CHECK(upper[7] == Approx(stretch).epsilon(round_off));
   CHECK(upper[9] == Approx(stretch).epsilon(round_off));
   CHECK(upper[5] ==
         Approx(finite ? 0.5 * (stretch * stretch - 1.0) : stretch - 1.0)
            .epsilon(round_off));
   CHECK(upper[6] == Approx(upper[5]).epsilon(round_off));
   CHECK(upper[0] == Approx(1.5 + 0.5 * (at.at(9)[3] + at.at(5)[3])));
   CHECK(upper[10] == Approx(0.5 * (at.at(9)[7] + at.at(5)[7])));
   CHECK(lower[10] == Approx(0.5 * (at.at(1)[7] + at.at(5)[7])));
   // Darcy's law, in the stretched element.
   CHECK(upper[11] ==
         Approx(0.01 * (at.at(5)[7] - at.at(9)[7]) / (finite ? stretch : 1.0))
            .epsilon(1e-6));
   CHECK(upper[11] > 0.0);
}

TEST_CASE("A run that goes on continues its logs")
{
   const TemporaryDirectory directory;
   CaseFile setup = PressedColumn(directory, false);
   setup.output.logs = {Log("p.txt", LogSubject::elements, {"p"})};
   setup.output.logs[0].numbers = {2};
   setup.output.checkpoint_every = 4;
   setup.time.end = 3.0;
   {
      Simulation simulation(setup, MPI_COMM_WORLD);
      for (int i = 0; i < 5; i++)
      {
         simulation.Step();
      }
   }
   REQUIRE(ReadLog(directory / "out/logs/p.txt").size() == 5);
   Simulation simulation(setup, MPI_COMM_WORLD);
   simulation.Resume();
   REQUIRE(simulation.Run() == 0);
   const std::vector<Block> blocks = ReadLog(directory / "out/logs/p.txt");
   REQUIRE(blocks.size() == 6);
   for (int i = 0; i < 6; i++)
   {
      CHECK(blocks[i].step == i + 1);
      CHECK(blocks[i].rows.size() == 1);
      CHECK(blocks[i].rows.count(2) == 1);
   }
}

TEST_CASE("What can't be logged is an error")
{
   const TemporaryDirectory directory;
   CaseFile setup = PressedColumn(directory, true);
   LogDefinition log = Log("n.txt", LogSubject::nodes, {"ux"});
   const auto message = [&]() -> std::string
   {
      setup.output.logs = {log};
      try
      {
         Simulation(setup, MPI_COMM_WORLD).Run();
      }
      catch (const Error &error)
      {
         return error.what();
      }
      return "";
   };
   log.numbers = {1, 77};
   CHECK_THAT(message(), Contains("no corner of an element with the number "
                                  "77"));
   log.numbers.clear();
   log.data = {"sx"};
   CHECK_THAT(message(), Contains("there is no \"sx\""));
   log.of = LogSubject::elements;
   setup.mesh.options.refine = 1;
   CHECK_THAT(message(), Contains("refined mesh"));
   setup.mesh.options.refine = 0;
   log.of = LogSubject::rigid_bodies;
   log.data = {"x"};
   CHECK_THAT(message(), Contains("there are no rigid bodies"));
   log.of = LogSubject::nodes;
   log.file = "a/b";
   CHECK_THAT(message(), Contains("output.log.0.file"));
}
