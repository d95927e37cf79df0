#include "synovia/runs/restart_rules.hpp"
#include "synovia/general/error.hpp"
#include "synovia/general/text.hpp"
#include "synovia/runs/run_output.hpp"

#include <algorithm>

namespace synovia
{

namespace
{
std::vector<CaseChange> ChangesSince(const std::string &text,
                                     const std::string &source,
                                     const CaseFile &setup)
{
   return FindChanges(ParseCase(text, "the case of " + source), setup);
}

void Verify(const std::vector<CaseChange> &changes, const std::string &source,
            const std::string &advice, const CaseFile &setup)
{
   std::vector<CaseChange> refused;
   std::copy_if(changes.begin(), changes.end(), std::back_inserter(refused),
                [](const CaseChange &change) { return !MayChange(change); });
   if (!refused.empty())
   {
      throw Error(source + " is of another case:\n" +
                  ToText(refused, setup.places) +
                  "\n  --resume takes a new title, time, solver or output "
                  "only; " +
                  advice);
   }
}

std::string NameOf(const Checkpoint &checkpoint)
{
   return "the checkpoint '" + checkpoint.File() + "'";
}
} // namespace

std::vector<CaseChange> ChangesToResume(const CaseFile &setup,
                                        const Checkpoint &checkpoint)
{
   const std::string go_on = "--restart " + checkpoint.File();
   if (checkpoint.Setup().empty())
   {
      throw Error(NameOf(checkpoint) +
                  " does not hold its case, for it is of an older version; if "
                  "it is this one, go on with " +
                  go_on);
   }
   const std::vector<CaseChange> changes =
      ChangesSince(checkpoint.Setup(), NameOf(checkpoint), setup);
   Verify(changes, NameOf(checkpoint),
          go_on + " goes on with what has changed, and --overwrite begins anew",
          setup);
   return changes;
}

std::vector<CaseChange> ChangesToRestart(const CaseFile &setup,
                                         const Checkpoint &checkpoint)
{
   if (checkpoint.Setup().empty())
   {
      return {};
   }
   return ChangesSince(checkpoint.Setup(), NameOf(checkpoint), setup);
}

void VerifySameProblem(const CaseFile &setup, const std::string &text,
                       const std::string &directory)
{
   if (!text.empty())
   {
      const std::string source = "the run in '" + directory + "'";
      Verify(ChangesSince(text, source, setup), source,
             "--overwrite replaces it", setup);
   }
}

void VerifyEnd(const CaseFile &setup, const Checkpoint &checkpoint)
{
   if (setup.time.end < checkpoint.Time() &&
       !IsSameTime(setup.time.end, checkpoint.Time(), setup.time))
   {
      throw Error(WhereIs(setup.places, "time.end") +
                  ": the run would end at " + ToText(setup.time.end) +
                  ", before " + NameOf(checkpoint) + ", which is of t = " +
                  ToText(checkpoint.Time()) + "; set a later end");
   }
}

} // namespace synovia
