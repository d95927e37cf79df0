// ranks: 1 2
//
// Tuning constants in a case file: read, checked, written, and obeyed by what
// they are for.

#include "support/boxes.hpp"
#include "synovia/cases/case_difference.hpp"
#include "synovia/cases/case_problem.hpp"
#include "synovia/general/error.hpp"
#include "synovia/time/time_stepper.hpp"

#include <catch2/catch.hpp>

#include <set>
#include <sstream>

using namespace mfem;
using namespace synovia;
using Catch::Matchers::Contains;

namespace
{
const std::string text = R"(
   [mesh]
   file = "boxes.msh"
   [space]
   order = 1
   [[material]]
   regions = ["lower", "upper"]
   solid = {E = 0.5, nu = 0.1}
   permeability = {value = 4e-3}
   [[boundary]]
   surfaces = ["lower_z0"]
   displacement = [0, 0, 0]
   [[boundary]]
   surfaces = ["upper_z1"]
   displacement = [0, 0, {times = [0, 4], values = [0, -0.02]}]
   [[contact]]
   name = "boxes"
   source = ["upper_z0"]
   destination = ["lower_z1"]
   [time]
   end = 4
   step = 1
)";

CaseFile Parsed(const std::vector<std::string> &settings)
{
   return ParseCase(text, "case.toml", settings);
}

std::string Problem(const std::string &setting)
{
   try
   {
      Parsed({setting});
   }
   catch (const Error &error)
   {
      return error.what();
   }
   return "";
}

/// The keys that --dry-schema lists below solver.tuning.
std::vector<std::string> TuningKeys()
{
   std::ostringstream out;
   ListCaseKeys(out);
   std::istringstream lines(out.str());
   std::vector<std::string> keys;
   for (std::string line; std::getline(lines, line);)
   {
      if (line.rfind("solver.tuning.", 0) == 0)
      {
         keys.push_back(line.substr(0, line.find(' ')));
      }
   }
   return keys;
}

/// A case that was run to its end.
struct Run
{
   WorkCounts work;
   int linear = 0;
   Vector state;
   real_t sealed = 0.0;
   real_t sealed_source = 0.0;
};

BoxOptions LowerBox(int cells)
{
   BoxOptions box;
   box.nx = cells;
   box.ny = cells;
   box.size_x = 1.2;
   box.size_y = 1.2;
   return box;
}

Run RunCase(const std::vector<std::string> &settings,
            const BoxOptions &lower = LowerBox(3))
{
   const CaseFile setup = Parsed(settings);
   NamedMesh mesh = MakeStack(lower, BoxOptions());
   CaseProblem problem(setup, mesh);
   TimeStepper stepper(problem.Get(), setup.time);
   Run run;
   while (!stepper.Done())
   {
      const StepReport report = stepper.Step();
      CAPTURE(report.reason);
      REQUIRE(report.converged);
      run.work += report.work;
      run.linear += report.solve.linear;
   }
   run.state = stepper.State();
   const ContactPair &pair = *problem.Get().Operator().Pairs().front();
   Vector sealed(problem.Get().Spaces().Multiplier().GetTrueVSize());
   sealed = 0.0;
   pair.MarkSealed(sealed);
   const auto count = [&sealed](const ContactSurface &surface)
   {
      real_t sum = 0.0;
      for (const int dof : surface.Vertices().TrueDofs())
      {
         sum += sealed[dof];
      }
      MPI_Allreduce(MPI_IN_PLACE, &sum, 1, MPITypeMap<real_t>::mpi_type,
                    MPI_SUM, MPI_COMM_WORLD);
      return sum;
   };
   run.sealed = count(pair.Geometry().Destination());
   run.sealed_source = count(pair.Geometry().Source());
   return run;
}
} // namespace

TEST_CASE("Every tuning constant has a key, and its default is the struct's")
{
   const std::vector<std::string> keys = TuningKeys();
   // A member without a key changes the size of the struct only.
   CHECK(sizeof(SolverTuning) <= keys.size() * sizeof(real_t));
   CHECK(keys.size() == 58);
   const CaseFile standard = Parsed({});
   for (const std::string &key : keys)
   {
      CAPTURE(key);
      const bool counts = key.find("max_") != std::string::npos ||
                          key.find("patience") != std::string::npos ||
                          key.find("batch") != std::string::npos ||
                          key.find("above") != std::string::npos ||
                          key.find("after") != std::string::npos ||
                          key.find("restart") != std::string::npos;
      const bool cut = key.find("most_cut") != std::string::npos;
      const bool flag = key.find("single_precision") != std::string::npos;
      const std::string value = counts ? "7"
                                : cut  ? "0.03"
                                : flag ? "false"
                                       : "1.0";
      const bool open =
         Problem(key + "=" + value).find("between") != std::string::npos;
      const std::vector<CaseChange> changes =
         FindChanges(standard, Parsed({key + "=" + (open ? "0.6" : value)}));
      REQUIRE(changes.size() == 1);
      CHECK(changes[0].path == key);
      CHECK(MayChange(changes[0]));
   }
   std::ostringstream written;
   WriteCase(Parsed({"solver.tuning.contact.rim_coverage=0.25"}), written);
   CHECK_THAT(written.str(), Contains("rim_coverage = 0.25"));
   const CaseFile again = ParseCase(written.str(), "written.toml");
   CHECK(again.solver.tuning.contact.rim_coverage == 0.25);
   CHECK(again.solver.tuning.factorization.max_columns ==
         SolverTuning().factorization.max_columns);
}

TEST_CASE("Wrong tuning is said where it is")
{
   CHECK_THAT(
      Problem("solver.tuning.contact.sealing_covrage=0.5"),
      Contains("solver.tuning.contact.sealing_covrage: there is no such "
               "key") &&
         Contains("did you mean \"sealing_coverage\"?"));
   CHECK_THAT(Problem("solver.tuning.newtn.max_searches=1"),
              Contains("did you mean \"newton\"?"));
   CHECK_THAT(Problem("solver.tuning.sealing_coverage=0.5"),
              Contains("there are: contact, newton, factorization, multigrid, "
                       "steps"));
   CHECK_THAT(Problem("solver.tuning.contact.sealing_coverage=1.5"),
              Contains("found 1.5; it must be from 0 to 1"));
   CHECK_THAT(Problem("solver.tuning.contact.kept_slide=-0.1"),
              Contains("solver.tuning.contact.kept_slide: found -0.1; it must "
                       "be at least 0"));
   CHECK_THAT(Problem("solver.tuning.contact.kept_slide=\"auto\""),
              Contains("solver.tuning.contact.kept_slide: found the string "
                       "\"auto\"; expected a number"));
   CHECK_THAT(Problem("solver.tuning.newton.final_accuracy=1.0"),
              Contains("found 1; it must be between 0 and 1"));
   CHECK_THAT(Problem("solver.tuning.factorization.column_batch=0"),
              Contains("found 0; it must be from 1 to 10000"));
   CHECK_THAT(Problem("solver.tuning.multigrid.restart=2.5"),
              Contains("found the number 2.5; expected integer"));
}

TEST_CASE("Tuning reaches the contact pair")
{
   // Of 16 and 4 vertices; the source ends within the faces at the rim.
   const Run standard = RunCase({});
   CHECK(standard.sealed == 4.0);
   CHECK(standard.sealed_source == 1.0);
   const Run covered = RunCase({"solver.tuning.contact.sealing_coverage=0.0"});
   CHECK(covered.sealed == 9.0);
   const std::string source = "solver.tuning.contact.source_sealing_coverage=";
   CHECK(RunCase({source + "1.0"}).sealed == standard.sealed);
   CHECK(RunCase({source + "1.0"}).sealed_source == 0.0);
   CHECK(RunCase({source + "0.0"}).sealed_source == 4.0);
}

TEST_CASE("Tuning reaches contact that slides in finite deformation")
{
   const std::vector<std::string> sliding = {
      "physics.deformation=\"finite\"",
      "material.0.solid={model=\"neo_hookean\", E=0.5, nu=0.1}",
      "boundary.1.displacement=[{times=[0, 4], values=[0, 0.15]}, 0, "
      "{times=[0, 4], values=[0, -0.02]}]",
      // All of the box stays covered.
      "contact.0.source=[\"lower_z1\"]",
      "contact.0.destination=[\"upper_z0\"]"};
   const auto searches = [&](const std::vector<std::string> &more)
   {
      std::vector<std::string> settings(sliding);
      settings.insert(settings.end(), more.begin(), more.end());
      return RunCase(settings).work.searches;
   };
   const std::string drift = "solver.tuning.contact.drift_of_";
   // One for each of the four steps: the first one takes points to other faces,
   // where gaps and areas are the same but for round-off.
   const std::string loose = drift + "tolerance=0.5";
   CHECK(searches({loose}) == 4);
   CHECK(searches({loose, drift + "area=0"}) > 4);
   CHECK(searches({drift + "tolerance=0", drift + "gap=0"}) > 4);
   CHECK(searches({drift + "area=0", drift + "tolerance=0", drift + "gap=0",
                   "solver.tuning.newton.max_searches=0"}) == 4);
}

TEST_CASE("Tuning reaches the factorization, and the choice of the method")
{
   const std::vector<std::string> direct = {"solver.linear=\"direct\""};
   const Run standard = RunCase(direct);
   const Run none =
      RunCase({direct[0], "solver.tuning.factorization.max_columns=0"});
   CAPTURE(standard.work.factorizations, none.work.factorizations);
   CHECK(standard.work.columns > 0);
   CHECK(none.work.columns == 0);
   CHECK(none.work.factorizations > standard.work.factorizations);
}

TEST_CASE("Factors that are too coarse are given up for better ones")
{
   const std::vector<std::string> direct = {
      "physics.deformation=\"finite\"",
      "material.0.solid={model=\"neo_hookean\", E=0.5, nu=0.1}",
      "solver.linear=\"direct\"", "time.end=1"};
   std::vector<std::string> coarse(direct);
   coarse.push_back("solver.tuning.factorization.compress_above=0");
   coarse.push_back("solver.tuning.factorization.compression=0.9");
   BoxOptions box = LowerBox(20);
   box.nz = 10;
   const Run standard = RunCase(direct, box);
   const Run refined = RunCase(coarse, box);
   CAPTURE(standard.work.factorizations, refined.work.factorizations);
   CHECK(refined.work.factorizations > standard.work.factorizations);
}

TEST_CASE("Large symmetric matrices have factors that are not exact")
{
   const std::vector<std::string> direct = {"solver.linear=\"direct\""};
   std::vector<std::string> large(direct);
   large.push_back("solver.tuning.factorization.compress_above=0");
   const BoxOptions box = LowerBox(8);
   const Run exact = RunCase(direct, box);
   Run coarse = RunCase(large, box);
#ifdef SYNOVIA_HAS_SINGLE_MUMPS
   CHECK(coarse.linear > exact.linear);
#endif
   REQUIRE(exact.state.Norml2() > 0.0);
   coarse.state -= exact.state;
   CHECK(coarse.state.Norml2() < 1e-6 * exact.state.Norml2());
}

TEST_CASE("Tuning reaches multigrid")
{
   const std::vector<std::string> amg = {"solver.linear=\"block_amg\""};
   const Run standard = RunCase(amg);
   const Run rebuilt =
      RunCase({amg[0], "solver.tuning.multigrid.rebuild_after=0",
               "solver.tuning.multigrid.rebuild_change=0"});
   CAPTURE(standard.work.setups, rebuilt.work.setups);
   CHECK(rebuilt.work.setups > standard.work.setups);
}
