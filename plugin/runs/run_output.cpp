#include "synovia/runs/run_output.hpp"
#include "synovia/general/root_rank.hpp"
#include "synovia/io/checkpoint.hpp"
#include "synovia/io/checkpoint_directory.hpp"
#include "synovia/io/log_tables.hpp"
#include "synovia/runs/line_output.hpp"

#include <cmath>
#include <filesystem>
#include <optional>

namespace synovia
{

using namespace mfem;

bool IsSameTime(real_t a, real_t b, const TimeOptions &options)
{
   constexpr real_t same_part = 2e-6;
   return std::abs(a - b) <= same_part * options.step;
}

namespace
{
std::unique_ptr<LogTables> MakeLogs(const CaseFile &setup,
                                    BiphasicProblem &problem)
{
   std::unique_ptr<LogTables> logs;
   CaseReading reading(setup.places);
   reading.Catch(
      "output.log", [&]()
      { logs = std::make_unique<LogTables>(setup.output.logs, problem); });
   reading.ThrowIfAny();
   return logs;
}
} // namespace

RunOutput::RunOutput(const CaseOfStep &step_, BiphasicProblem &problem_,
                     const std::string &text_)
   : step(step_), setup(step.setup), problem(problem_), text(text_),
     lines(std::make_unique<LineOutput>(setup, problem)),
     logs(MakeLogs(setup, problem))
{
}

RunOutput::~RunOutput() = default;

void RunOutput::Open(TimeStepper &stepper_, bool goes_on)
{
   stepper = &stepper_;
   const std::string &directory = setup.output.directory;
   const MPI_Comm comm = problem.Mesh().GetComm();
   // A run that goes on in another directory starts a history there.
   history = std::make_unique<History>(
      directory, comm,
      goes_on &&
            OfRoot(std::filesystem::exists(directory + "/history.csv"), comm)
         ? std::optional<real_t>(stepper->Time())
         : std::nullopt);
   logs->Open(directory,
              goes_on ? std::optional<real_t>(stepper->Time()) : std::nullopt);
   if (setup.output.fields_every > 0)
   {
      fields =
         std::make_unique<FieldOutput>(directory, problem, *stepper, goes_on);
   }
}

void RunOutput::Record(const History::Row &row)
{
   if (step.name.empty())
   {
      history->Add(row);
   }
   else
   {
      history->AddVarying(row);
   }
   const int every = setup.output.fields_every;
   if (fields && (stepper->Steps() % every == 0 || stepper->Done()))
   {
      fields->Save();
   }
   std::vector<size_t> due;
   for (size_t i = 0; i < setup.output.lines.size(); i++)
   {
      const std::vector<real_t> &times = setup.output.lines[i].times;
      bool now = times.empty() && stepper->Done();
      for (const real_t time : times)
      {
         now = now || IsSameTime(time, stepper->Time(), setup.time);
      }
      if (now)
      {
         due.push_back(i);
      }
   }
   lines->Write(due, *stepper);
   logs->Write(*stepper);
}

bool RunOutput::CheckpointIsDue() const
{
   const int every = setup.output.checkpoint_every;
   return every > 0 && (stepper->Steps() % every == 0 || stepper->Done());
}

std::string RunOutput::WriteCheckpoint()
{
   const std::string file = synovia::WriteCheckpoint(
      setup.output.directory + "/checkpoint", problem, *stepper, text);
   if (stepper->Done() && !step.name.empty())
   {
      KeepCheckpoint(file, step.name, problem.Mesh().GetComm());
   }
   return file;
}

} // namespace synovia
