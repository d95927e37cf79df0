// ranks: 1 3
// timeout: 300
//
// The shipped cases, damaged in all the ways that hands and disks do it: each
// is either an error that says where, or a case that makes sense, which can be
// set up and written. Nothing crashes, hangs, or throws anything else.

#include "support/shipped_cases.hpp"
#include "support/text_damage.hpp"
#include "synovia/cases/case_file.hpp"
#include "synovia/general/error.hpp"
#include "synovia/runs/line_output.hpp"
#include "synovia/runs/problem_report.hpp"
#include "synovia/runs/step_sequence.hpp"
#include "synovia/runs/step_table.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <chrono>
#include <sstream>

using namespace mfem;
using namespace synovia;

namespace
{
constexpr const char *source = "case.toml";

/// What became of a text: a complaint, or none.
std::string Try(const std::string &text, ShippedCase &shipped)
{
   try
   {
      const CaseFile setup = ParseCase(text, source);
      StepSequence steps(setup, shipped.MeshFor(setup));
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
   std::vector<std::string> names;
   for (ShippedCase &shipped : ShippedCases())
   {
      CAPTURE(shipped.name);
      CHECK(Try(shipped.text, shipped) == "");
      names.push_back(shipped.name);
   }
   std::sort(names.begin(), names.end());
   CHECK(names == ShippedNames());
}

TEST_CASE("A damaged case is an error that says where, or a case", "[case]")
{
   using Clock = std::chrono::steady_clock;
   std::vector<ShippedCase> cases = ShippedCases();
   const unsigned count = Mpi::WorldSize() == 1 ? 600 : 100; // of each
   unsigned errors = 0;
   unsigned good = 0;
   unsigned seed = 0;
   for (ShippedCase &shipped : cases)
   {
      const std::string text = WithoutComments(shipped.text);
      for (unsigned i = 0; i < count; i++)
      {
         const std::string mutant = DamagedText(text, ++seed);
         CAPTURE(shipped.name, seed, mutant);
         const Clock::time_point start = Clock::now();
         const std::string said = Try(mutant, shipped);
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
         const std::vector<std::string> lines = LinesOf(said);
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
