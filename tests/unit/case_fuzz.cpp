// ranks: 1 3
// timeout: 300
//
// The shipped cases, damaged in all the ways that hands and disks do it: each
// is either an error that says where, or a case that makes sense, which can be
// set up and written. Nothing crashes, hangs, or throws anything else.

#include "support/boxes.hpp"
#include "support/feb_text.hpp"
#include "synovia/cases/case_file.hpp"
#include "synovia/general/error.hpp"
#include "synovia/mesh/stack_bodies.hpp"
#include "synovia/runs/line_output.hpp"
#include "synovia/runs/problem_report.hpp"
#include "synovia/runs/step_sequence.hpp"
#include "synovia/runs/step_table.hpp"

#include <catch2/catch.hpp>

#include <array>
#include <chrono>
#include <cmath>
#include <fstream>
#include <random>
#include <sstream>

using namespace mfem;
using namespace synovia;

namespace
{
constexpr const char *source = "case.toml";

std::string ReadShipped(const std::string &name)
{
   std::ifstream file(std::string(SYNOVIA_SOURCE_DIR) + "/miniapps/cases/" +
                      name + ".toml");
   std::ostringstream text;
   text << file.rdbuf();
   REQUIRE(file);
   return text.str();
}

/// A shipped case with a mesh of boxes that has its names.
struct Shipped
{
   std::string name;
   std::string text;
   NamedMesh mesh;
};

NamedMesh OneBox(const std::string &region, const NameTable &boundaries,
                 real_t size_x, real_t size_z)
{
   BoxOptions box;
   box.nx = 3;
   box.nz = 2;
   box.size_x = size_x;
   box.size_y = size_x;
   box.size_z = size_z;
   Mesh mesh = MakeBoxMesh(box);
   return DistributeMesh(mesh, {{region, {1}}}, boundaries, MPI_COMM_WORLD);
}

NamedMesh TwoBoxes(const std::string &lower_name, const std::string &upper_name,
                   const NameTable &boundaries, real_t lower_size,
                   real_t upper_size, real_t height = 0.75)
{
   BoxOptions lower;
   lower.nx = 2;
   lower.nz = 2;
   lower.size_x = lower_size;
   lower.size_y = lower_size;
   lower.size_z = height;
   BoxOptions upper = lower;
   upper.size_x = upper_size;
   upper.size_y = upper_size;
   Mesh mesh = MakeStackMesh(lower, upper);
   return DistributeMesh(mesh, {{lower_name, {1}}, {upper_name, {2}}},
                         boundaries, MPI_COMM_WORLD);
}

/// Any number of bodies, each a box or one that is bent.
class Bodies
{
public:
   /// @a sides are the names of z0, y0, x1, y1, x0 and z1.
   void Add(const std::string &region, Mesh mesh,
            const std::array<std::string, 6> &sides)
   {
      meshes.push_back(std::move(mesh));
      names.push_back({region, sides});
   }

   NamedMesh Distribute() const
   {
      std::vector<const Mesh *> borrowed;
      for (const Mesh &mesh : meshes)
      {
         borrowed.push_back(&mesh);
      }
      StackedBodies all = StackBodies(borrowed);
      NameTable regions;
      NameTable boundaries;
      for (size_t i = 0; i < names.size(); i++)
      {
         regions[names[i].region] = {1 + all.region_offsets[i]};
         for (int side = 0; side < 6; side++)
         {
            boundaries[names[i].sides[side]].push_back(1 + side +
                                                       all.boundary_offsets[i]);
         }
      }
      return DistributeMesh(all.mesh, regions, boundaries, MPI_COMM_WORLD);
   }

private:
   struct Names
   {
      std::string region;
      std::array<std::string, 6> sides;
   };
   std::vector<Mesh> meshes;
   std::vector<Names> names;
};

/// A box with its middle above (x, y).
Mesh Plate(real_t x, real_t y, real_t bottom, real_t size, real_t height)
{
   BoxOptions box;
   box.nx = 2;
   box.nz = 2;
   box.size_x = size;
   box.size_y = size;
   box.size_z = height;
   Mesh mesh = MakeBoxMesh(box);
   for (int i = 0; i < mesh.GetNV(); i++)
   {
      real_t *const vertex = mesh.GetVertex(i);
      vertex[0] += x - 0.5 * size;
      vertex[1] += y - 0.5 * size;
      vertex[2] += bottom;
   }
   return mesh;
}

/// A box bent around (x, 0), radii 5 to 15, from one angle to another: x0 is
/// the inner side, y0 the end at the first angle.
Mesh Arc(real_t x, real_t from, real_t to)
{
   BoxOptions box;
   box.ny = 4;
   box.nz = 1;
   Mesh mesh = MakeBoxMesh(box);
   for (int i = 0; i < mesh.GetNV(); i++)
   {
      real_t *const vertex = mesh.GetVertex(i);
      const real_t radius = 5.0 + 10.0 * vertex[0];
      const real_t angle = from + (to - from) * vertex[1];
      vertex[0] = x + radius * std::cos(angle);
      vertex[1] = radius * std::sin(angle);
      vertex[2] *= 2.0;
   }
   return mesh;
}

NamedMesh RingOfMeniscus()
{
   Bodies bodies;
   bodies.Add("tibial_cartilage", Plate(8.0, 8.0, -2.0, 16.0, 2.0),
              {"tibial_cartilage_bone", "symmetry_y", "tibial_cartilage_rim",
               "tibial_cartilage_rim", "symmetry_x",
               "tibial_cartilage_contact"});
   bodies.Add("meniscus", Arc(0.0, 0.0, M_PI / 2),
              {"meniscus_inferior", "symmetry_y", "meniscus_periphery",
               "symmetry_x", "meniscus_inner", "meniscus_superior"});
   bodies.Add("femoral_cartilage", Plate(8.0, 8.0, 2.0, 16.0, 2.0),
              {"femoral_cartilage_contact", "symmetry_y",
               "femoral_cartilage_rim", "femoral_cartilage_rim", "symmetry_x",
               "femoral_cartilage_bone"});
   return bodies.Distribute();
}

NamedMesh Knee()
{
   const auto cartilage = [](const std::string &name, bool below)
   {
      const std::string rim = name + "_rim";
      const std::string contact = name + "_contact";
      const std::string bone = name + "_bone";
      return std::array<std::string, 6>{
         below ? bone : contact, rim, rim, rim, rim, below ? contact : bone};
   };
   Bodies bodies;
   bodies.Add("femoral_cartilage", Plate(0.0, 0.0, 2.0, 90.0, 2.0),
              cartilage("femoral_cartilage", false));
   for (const std::string side : {"medial", "lateral"})
   {
      const real_t x = side == "medial" ? -22.0 : 22.0;
      const std::string tibia = "tibial_cartilage_" + side;
      const std::string meniscus = "meniscus_" + side;
      bodies.Add(tibia, Plate(x, 0.0, -2.0, 40.0, 2.0), cartilage(tibia, true));
      bodies.Add(meniscus, Arc(x, M_PI / 2, 3 * M_PI / 2),
                 {meniscus + "_inferior", meniscus + "_horn_anterior",
                  meniscus + "_periphery", meniscus + "_horn_posterior",
                  meniscus + "_inner", meniscus + "_superior"});
   }
   return bodies.Distribute();
}

// The attributes of a box's sides: z0 1, y0 2, x1 3, y1 4, x0 5, z1 6; those
// of an upper box are 6 more.
std::vector<Shipped> ShippedCases()
{
   std::vector<Shipped> cases;
   const auto add = [&](const std::string &name, NamedMesh mesh) {
      cases.push_back({name, ReadShipped(name), std::move(mesh)});
   };
   for (const std::string variant : {"", "_finite"})
   {
      add("confined_compression" + variant,
          OneBox("cartilage",
                 {{"bottom", {1}},
                  {"top", {6}},
                  {"sides_x", {3, 5}},
                  {"sides_y", {2, 4}}},
                 0.2, variant.empty() ? 0.75 : 1.0));
      // Keys that no shipped case has.
      cases.back().text =
         Replaced(cases.back().text, "[[material]]\n",
                  "[[material]]\nsupply = {model = \"starling\", kp = 0.1, "
                  "pc = 0.2}\n") +
         "[[output.log]]\nfile = \"log.txt\"\nof = \"nodes\"\n"
         "data = [\"ux\", \"Rz\"]\nnumbers = [1, 2]\n"
         "surfaces = [\"top\"]\nregions = [\"cartilage\"]\n"
         "delimiter = \",\"\n";
      add("unconfined_compression" + variant, OneBox("cartilage",
                                                     {{"bottom", {1}},
                                                      {"top", {6}},
                                                      {"symmetry_x", {5}},
                                                      {"symmetry_y", {2}},
                                                      {"side", {3, 4}}},
                                                     1.5, 0.25));
   }
   add("relaxation_and_recovery", OneBox("cartilage",
                                         {{"bottom", {1}},
                                          {"top", {6}},
                                          {"sides_x", {3, 5}},
                                          {"sides_y", {2, 4}}},
                                         0.2, 0.75));
   add("two_columns", TwoBoxes("lower", "upper",
                               {{"lower_bottom", {1}},
                                {"lower_top", {6}},
                                {"lower_sides_x", {3, 5}},
                                {"lower_sides_y", {2, 4}},
                                {"upper_bottom", {7}},
                                {"upper_top", {12}},
                                {"upper_sides_x", {9, 11}},
                                {"upper_sides_y", {8, 10}}},
                               0.3, 0.3));
   add("osteochondral_core", TwoBoxes("bone", "cartilage",
                                      {{"bone_bottom", {1}},
                                       {"bone_top", {6}},
                                       {"bone_sides_x", {3, 5}},
                                       {"bone_sides_y", {2, 4}},
                                       {"cartilage_bottom", {7}},
                                       {"cartilage_top", {12}},
                                       {"cartilage_sides_x", {9, 11}},
                                       {"cartilage_sides_y", {8, 10}}},
                                      0.4, 0.4, 1.0));
   add("friction_plate", TwoBoxes("plate", "column",
                                  {{"plate_bottom", {1}},
                                   {"plate_top", {6}},
                                   {"plate_sides_x", {3, 5}},
                                   {"plate_sides_y", {2, 4}},
                                   {"column_bottom", {7}},
                                   {"column_top", {12}},
                                   {"column_sides_x", {9, 11}},
                                   {"column_sides_y", {8, 10}}},
                                  0.4, 0.4));
   for (const std::string name : {"indentation", "indentation_hexahedra"})
   {
      add(name, TwoBoxes("cartilage", "indenter",
                         {{"bone", {1}},
                          {"cartilage_top", {6}},
                          {"cartilage_side", {3, 4}},
                          {"symmetry_x", {5, 11}},
                          {"symmetry_y", {2, 8}},
                          {"indenter_bottom", {7}},
                          {"indenter_top", {12}},
                          {"indenter_side", {9, 10}}},
                         3.0, 0.75));
   }
   add("hertz", TwoBoxes("lower", "upper",
                         {{"lower_bottom", {1}},
                          {"lower_contact", {6}},
                          {"lower_sides", {3, 4}},
                          {"symmetry_x", {5, 11}},
                          {"symmetry_y", {2, 8}},
                          {"upper_contact", {7}},
                          {"upper_top", {12}},
                          {"upper_sides", {9, 10}}},
                         10.0, 10.0));
   for (const std::string name :
        {"glenohumeral", "glenohumeral_hexahedra", "glenohumeral_ligaments"})
   {
      add(name, TwoBoxes("glenoid", "humeral",
                         {{"glenoid_bone", {1}},
                          {"glenoid_contact", {6}},
                          {"glenoid_rim", {3, 4}},
                          {"symmetry_x", {5, 11}},
                          {"symmetry_y", {2, 8}},
                          {"humeral_contact", {7}},
                          {"humeral_bone", {12}},
                          {"humeral_rim", {9, 10}}},
                         10.0, 10.0, 1.5));
   }
   add("meniscus_ring", RingOfMeniscus());
   add("knee", Knee());
   return cases;
}

using Random = std::mt19937;

// The same on all platforms, unlike the standard distributions.
size_t Pick(Random &random, size_t count)
{
   return random() % count;
}

std::vector<std::string> Lines(const std::string &text)
{
   std::vector<std::string> lines;
   std::istringstream stream(text);
   for (std::string line; std::getline(stream, line);)
   {
      lines.push_back(line);
   }
   return lines;
}

std::string Joined(const std::vector<std::string> &lines)
{
   std::string text;
   for (const std::string &line : lines)
   {
      text += line + '\n';
   }
   return text;
}

// Where words made of these letters begin and how long they are.
std::vector<std::pair<size_t, size_t>> Words(const std::string &text,
                                             const std::string &letters)
{
   std::vector<std::pair<size_t, size_t>> words;
   for (size_t at = text.find_first_of(letters); at != std::string::npos;
        at = text.find_first_of(letters, at))
   {
      const size_t end =
         std::min(text.find_first_not_of(letters, at), text.size());
      words.emplace_back(at, end - at);
      at = end;
   }
   return words;
}

const std::string digits = "0123456789.";
const std::string letters = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVW"
                            "XYZ_";

std::string ChangeNumber(std::string text, Random &random)
{
   static const std::vector<std::string> nonsense = {
      "nan",        "inf",
      "-inf",       "0",
      "-1",         "1e999",
      "1e300",      "-0.0",
      "1e-300",     "1e-30",
      "1e30",       "true",
      "\"1\"",      "[]",
      "{}",         "[1, 2]",
      "0x10",       "1_000",
      "1.5",        "3",
      "7",          "",
      "--1",        "1e",
      "1979-05-27", "9223372036854775808",
      "2147483648", "100000000",
      "\"auto\"",   "\"free\""};
   const auto numbers = Words(text, digits);
   const auto [at, size] = numbers[Pick(random, numbers.size())];
   return text.replace(at, size, nonsense[Pick(random, nonsense.size())]);
}

std::string Misspell(std::string text, Random &random)
{
   const auto words = Words(text, letters);
   const auto [at, size] = words[Pick(random, words.size())];
   const size_t letter = at + Pick(random, size);
   switch (Pick(random, 4))
   {
   case 0:
      return text.erase(letter, 1);
   case 1:
      return text.insert(letter, 1, letters[Pick(random, letters.size())]);
   case 2:
      text[letter] = letters[Pick(random, letters.size())];
      return text;
   default:
      std::swap(text[letter], text[at]);
      return text;
   }
}

std::string ChangeLines(const std::string &text, Random &random)
{
   std::vector<std::string> lines = Lines(text);
   const size_t i = Pick(random, lines.size());
   const size_t j = Pick(random, lines.size());
   switch (Pick(random, 4))
   {
   case 0:
      lines.erase(lines.begin() + i);
      break;
   case 1:
      lines.insert(lines.begin() + j, std::string(lines[i]));
      break;
   case 2:
      std::swap(lines[i], lines[j]);
      break;
   default:
      std::rotate(lines.begin() + std::min(i, j),
                  lines.begin() + std::max(i, j), lines.end());
   }
   return Joined(lines);
}

std::string ChangeBytes(std::string text, Random &random)
{
   const size_t at = Pick(random, text.size());
   switch (Pick(random, 4))
   {
   case 0:
      text.resize(at);
      return text;
   case 1:
      text[at] = static_cast<char>(Pick(random, 256));
      return text;
   case 2:
      return text.erase(at, 1 + Pick(random, 30));
   default:
      for (size_t i = 0; i < 1 + Pick(random, 20); i++)
      {
         text.insert(at, 1, static_cast<char>(Pick(random, 256)));
      }
      return text;
   }
}

// Puts one thing of the text where another one was.
std::string Transplant(std::string text, Random &random)
{
   const std::string any = letters + digits + "\"";
   const auto words = Words(text, any);
   const auto [from, length] = words[Pick(random, words.size())];
   const std::string word = text.substr(from, length);
   const auto [to, size] = words[Pick(random, words.size())];
   return text.replace(to, size, word);
}

std::string Punctuate(std::string text, Random &random)
{
   const std::string marks = "[]{}=,\"'#.\n\\";
   const size_t at = Pick(random, text.size());
   return text.insert(at, 1, marks[Pick(random, marks.size())]);
}

// What is not a comment: to damage that is not worth a run.
std::string WithoutComments(const std::string &text)
{
   std::vector<std::string> lines;
   for (const std::string &line : Lines(text))
   {
      if (!line.empty() && line[0] != '#')
      {
         lines.push_back(line);
      }
   }
   return Joined(lines);
}

std::string Mutate(const std::string &text, unsigned seed)
{
   Random random(seed);
   std::string (*const ways[])(std::string, Random &) = {
      ChangeNumber, ChangeNumber, Misspell, ChangeBytes, Transplant, Punctuate};
   std::string mutant = text;
   const size_t times = 1 + Pick(random, 3);
   for (size_t i = 0; i < times && mutant.size() > 10; i++)
   {
      const size_t way = Pick(random, 7);
      mutant =
         way == 6 ? ChangeLines(mutant, random) : ways[way](mutant, random);
      if (Words(mutant, digits).empty() || Words(mutant, letters).empty())
      {
         break;
      }
   }
   return mutant;
}

/// What became of a text: a complaint, or none.
std::string Try(const std::string &text, NamedMesh &mesh)
{
   try
   {
      const CaseFile setup = ParseCase(text, source);
      StepSequence steps(setup, mesh);
      const ProblemReport report(steps.Present().setup, steps.Problem());
      const LineOutput lines(setup, steps.Problem().Get());
      std::ostringstream out;
      report.Write(out);
      WriteSteps(setup, out);
      // Behind the title, which may be any text.
      CHECK(out.str().find("nan", setup.title.size()) == std::string::npos);

      // It is written as it was understood.
      std::ostringstream written;
      WriteCase(setup, written);
      std::ostringstream again;
      WriteCase(ParseCase(written.str(), source), again);
      CHECK(again.str() == written.str());
      return "";
   }
   catch (const Error &error)
   {
      CHECK(error.what() != std::string());
      return error.what();
   }
}
} // namespace

TEST_CASE("The shipped cases fit the meshes of this test", "[case]")
{
   for (Shipped &shipped : ShippedCases())
   {
      CAPTURE(shipped.name);
      CHECK(Try(shipped.text, shipped.mesh) == "");
   }
}

TEST_CASE("A damaged case is an error that says where, or a case", "[case]")
{
   using Clock = std::chrono::steady_clock;
   std::vector<Shipped> cases = ShippedCases();
   const unsigned count = Mpi::WorldSize() == 1 ? 600 : 100; // of each
   unsigned errors = 0;
   unsigned good = 0;
   unsigned seed = 0;
   for (Shipped &shipped : cases)
   {
      const std::string text = WithoutComments(shipped.text);
      for (unsigned i = 0; i < count; i++)
      {
         const std::string mutant = Mutate(text, ++seed);
         CAPTURE(shipped.name, seed, mutant);
         const Clock::time_point start = Clock::now();
         const std::string said = Try(mutant, shipped.mesh);
         const std::chrono::duration<double> seconds = Clock::now() - start;
         CAPTURE(said);
         CHECK(seconds.count() < 10.0);
         if (said.empty())
         {
            good++;
            continue;
         }
         errors++;
         // A place, a line each, and no more than one can read.
         CHECK(said.rfind(source, 0) == 0);
         CHECK(said.find("MFEM") == std::string::npos);
         const std::vector<std::string> lines = Lines(said);
         CHECK(lines.size() <= 12);
         for (const std::string &line : lines)
         {
            CHECK(line.size() < 1000);
         }
      }
   }
   INFO(errors << " errors, " << good << " good");
   CHECK(errors + good == cases.size() * count);
   CHECK(errors > 2 * count);
   CHECK(good > count / 10);
}

TEST_CASE("A misspelt key is never overlooked", "[case]")
{
   std::vector<Shipped> cases = ShippedCases();
   int misspelt = 0;
   for (Shipped &shipped : cases)
   {
      const std::vector<std::string> lines =
         Lines(WithoutComments(shipped.text));
      for (size_t i = 0; i < lines.size(); i++)
      {
         const size_t end = lines[i].find(' ');
         if (end == std::string::npos || lines[i].find(" = ") != end)
         {
            continue;
         }
         // Another letter in the key, at each place of it.
         for (size_t k = 0; k < end; k++)
         {
            std::vector<std::string> changed(lines);
            changed[i][k] = 'q';
            const std::string key = changed[i].substr(0, end);
            CAPTURE(shipped.name, changed[i]);
            std::string said;
            try
            {
               ParseCase(Joined(changed), source);
            }
            catch (const Error &error)
            {
               said = error.what();
            }
            CHECK(said.find(key + ": there is no such key") !=
                  std::string::npos);
            CHECK(said.find(source + std::string(":") + std::to_string(i + 1) +
                            ":1: ") != std::string::npos);
            misspelt++;
         }
      }
   }
   CHECK(misspelt > 500);
}
