// ranks: 1
// timeout: 600
//
// A model of FEBio, damaged in all the ways that hands and disks do it: each is
// refused with a line number, or becomes a case that can be checked and whose
// mesh can be read. Nothing crashes, hangs, or throws anything else.
// SYNOVIA_FEB_MUTATIONS sets how many there are.

#include "support/feb_text.hpp"
#include "support/temporary_directory.hpp"
#include "synovia/cases/case_problem.hpp"
#include "synovia/feb/feb_import.hpp"
#include "synovia/general/error.hpp"

#include <catch2/catch.hpp>

#include <chrono>
#include <cstdlib>
#include <fstream>
#include <random>
#include <sstream>

using namespace mfem;
using namespace synovia;

namespace
{
int Mutations()
{
   const char *const wanted = std::getenv("SYNOVIA_FEB_MUTATIONS");
   return wanted ? std::atoi(wanted) : 2000;
}

class Mutator
{
public:
   explicit Mutator(unsigned seed) : random(seed) {}

   std::string operator()(const std::string &text)
   {
      const int kind = Pick(7);
      return kind == 0   ? WithoutLine(text)
             : kind == 1 ? WithLineTwice(text)
             : kind == 2 ? WithLinesSwapped(text)
             : kind == 3 ? WithOtherNumber(text)
             : kind == 4 ? WithOtherCharacters(text)
             : kind == 5 ? text.substr(0, Pick(text.size()))
                         : WithOtherName(text);
   }

private:
   size_t Pick(size_t count) { return random() % std::max<size_t>(count, 1); }

   static std::vector<std::string> Lines(const std::string &text)
   {
      std::vector<std::string> lines;
      std::istringstream in(text);
      for (std::string line; std::getline(in, line);)
      {
         lines.push_back(line + "\n");
      }
      return lines;
   }
   static std::string Joined(const std::vector<std::string> &lines)
   {
      std::string text;
      for (const std::string &line : lines)
      {
         text += line;
      }
      return text;
   }
   std::string WithoutLine(const std::string &text)
   {
      auto lines = Lines(text);
      lines[Pick(lines.size())].clear();
      return Joined(lines);
   }
   std::string WithLineTwice(const std::string &text)
   {
      auto lines = Lines(text);
      std::string &line = lines[Pick(lines.size())];
      line += line;
      return Joined(lines);
   }
   std::string WithLinesSwapped(const std::string &text)
   {
      auto lines = Lines(text);
      std::swap(lines[Pick(lines.size())], lines[Pick(lines.size())]);
      return Joined(lines);
   }
   std::string WithOtherNumber(const std::string &text)
   {
      const std::vector<std::string> others{
         "-1",   "0",    "1e400", "nan",  "99999999999999999999", "", "two",
         "1e-9", "1e12", "2.5",   "-0.25"};
      std::vector<size_t> digits;
      for (size_t i = 0; i < text.size(); i++)
      {
         if (std::isdigit(static_cast<unsigned char>(text[i])) &&
             !std::isdigit(static_cast<unsigned char>(text[i - 1])))
         {
            digits.push_back(i);
         }
      }
      const size_t at = digits[Pick(digits.size())];
      const size_t end = text.find_first_not_of("0123456789.", at);
      return text.substr(0, at) + others[Pick(others.size())] +
             text.substr(end);
   }
   std::string WithOtherCharacters(const std::string &text)
   {
      std::string other(text);
      for (size_t i = 0; i <= Pick(3); i++)
      {
         other[Pick(other.size())] = static_cast<char>(Pick(256));
      }
      return other;
   }
   std::string WithOtherName(const std::string &text)
   {
      const std::vector<std::string> names{
         "hex8",      "bc",      "tissue", "column",      "z_dof",
         "traction",  "perm",    "phi0",   "neo-Hookean", "biphasic",
         "top",       "bottom",  "body",   "LINEAR",      "TRANSIENT",
         "step_size", "NodeSet", "elem",   "SolidDomain", "Material",
         "node_set",  "type",    "id",     "mat",         "surface"};
      const size_t at = text.find(names[Pick(names.size())]);
      const std::string other = names[Pick(names.size())];
      return at == std::string::npos
                ? text
                : text.substr(0, at) + other + text.substr(at + other.size());
   }

   std::mt19937 random;
};

enum class Outcome
{
   refused,
   refused_later,
   taken
};

// Throws anything that isn't an Error of a user.
Outcome Try(const std::string &text, const TemporaryDirectory &directory)
{
   FebImport import;
   try
   {
      import = ImportFeb(text, "model.feb");
   }
   catch (const Error &error)
   {
      INFO(error.what());
      CHECK(std::string(error.what()).find("model.feb:") == 0);
      return Outcome::refused;
   }
   if (import.report.IsStopped())
   {
      const std::string stops =
         import.report.Text(FebReport::Fate::unsupported);
      INFO(stops);
      CHECK(stops.find("line") != std::string::npos);
      return Outcome::refused;
   }
   const std::string file = directory.Path() + "/model.msh";
   std::ofstream(file) << import.mesh;
   try
   {
      CheckCase(import.setup);
      NamedMesh mesh = ReadGmsh(file, MPI_COMM_WORLD);
      CaseProblem problem(import.setup, mesh);
   }
   catch (const Error &error)
   {
      CHECK(std::string(error.what()) != "");
      return Outcome::refused_later;
   }
   return Outcome::taken;
}
} // namespace

TEST_CASE("Damaged models are refused or run")
{
   const std::vector<std::string> texts{FebColumn(), FebPressedColumn(),
                                        FebGuidedColumn(), FebSteppedColumn()};
   const TemporaryDirectory directory(MPI_COMM_WORLD);
   for (const std::string &text : texts)
   {
      CAPTURE(text);
      REQUIRE(Try(text, directory) == Outcome::taken);
   }
   int counts[3] = {0, 0, 0};
   double longest = 0.0;
   for (int i = 0; i < Mutations(); i++)
   {
      Mutator mutate(static_cast<unsigned>(i));
      const std::string &text = texts[i % texts.size()];
      std::string damaged = mutate(text);
      if (i % 5 == 0)
      {
         damaged = mutate(damaged.empty() ? text : damaged + "\n");
      }
      CAPTURE(i, damaged);
      const auto start = std::chrono::steady_clock::now();
      counts[static_cast<int>(Try(damaged, directory))]++;
      const std::chrono::duration<double> taken =
         std::chrono::steady_clock::now() - start;
      longest = std::max(longest, taken.count());
   }
   CAPTURE(counts[0], counts[1], counts[2], longest);
   CHECK(counts[0] > Mutations() / 3);
   CHECK(counts[2] > Mutations() / 20);
   CHECK(longest < 10.0);
}
