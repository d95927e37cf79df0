#include "synovia/runs/run_output.hpp"
#include "synovia/general/root_rank.hpp"
#include "synovia/io/checkpoint.hpp"
#include "synovia/runs/line_output.hpp"
#include "synovia/runs/run_directory.hpp"

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

RunOutput::RunOutput(const CaseFile &setup_, BiphasicProblem &problem_)
   : setup(setup_), problem(problem_),
     lines(std::make_unique<LineOutput>(setup, problem))
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
   if (setup.output.fields_every > 0)
   {
      fields =
         std::make_unique<FieldOutput>(directory, problem, *stepper, goes_on);
   }
}

void RunOutput::Record(const History::Row &row)
{
   history->Add(row);
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
}

bool RunOutput::CheckpointIsDue() const
{
   const int every = setup.output.checkpoint_every;
   return every > 0 && (stepper->Steps() % every == 0 || stepper->Done());
}

std::string RunOutput::WriteCheckpoint()
{
   return synovia::WriteCheckpoint(setup.output.directory + "/checkpoint",
                                   problem, *stepper, SetupText(setup));
}

} // namespace synovia
