#include "cases/simulation.hpp"
#include "cases/contact_check.hpp"
#include "cases/line_output.hpp"
#include "cases/problem_report.hpp"
#include "general/error.hpp"
#include "general/text.hpp"
#include "general/version.hpp"
#include "io/checkpoint.hpp"
#include "io/output_directory.hpp"
#include "io/step_diagnostics.hpp"

#include <cerrno>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <iostream>
#include <optional>
#include <sstream>

namespace synovia
{

using namespace mfem;

namespace
{
// Times closer than this part of a step are the same.
constexpr real_t same_part = 2e-6;

const CaseFile &Checked(const CaseFile &setup)
{
   CheckCase(setup);
   return setup;
}

bool IsRoot(MPI_Comm comm)
{
   int rank = 0;
   MPI_Comm_rank(comm, &rank);
   return rank == 0;
}

// Whether a file is there, as rank 0 sees it.
bool IsThere(const std::string &file, MPI_Comm comm)
{
   int there = 0;
   if (IsRoot(comm))
   {
      there = std::filesystem::exists(file);
   }
   MPI_Bcast(&there, 1, MPI_INT, 0, comm);
   return there != 0;
}

// Whether there is one to go on with.
bool HasHistory(const std::string &directory, MPI_Comm comm)
{
   return IsThere(directory + "/history.csv", comm);
}

// What makes a mesh that isn't there, if the case says so.
std::string MeshAdvice(const CaseFile &setup, MPI_Comm comm)
{
   const MeshGenerator &generator = setup.mesh.generator;
   if (generator.script.empty() || IsThere(setup.mesh.file, comm))
   {
      return "";
   }
   std::string command = "meshes/" + generator.script;
   for (const std::string &argument : generator.arguments)
   {
      command += " " + argument;
   }
   const auto file = setup.places.find("");
   return "; to make it and run the case: scripts/run " +
          (file == setup.places.end() ? "CASE.toml" : file->second.source) +
          "; to make it: scripts/python " + command + " -o " + setup.mesh.file;
}

NamedMesh ReadMesh(const CaseFile &setup, MPI_Comm comm)
{
   try
   {
      return ReadGmsh(setup.mesh.file, comm, setup.mesh.options);
   }
   catch (const Error &error) // on all ranks alike
   {
      throw Error(WhereIs(setup.places, "mesh.file") + ": " + error.what() +
                  MeshAdvice(setup, comm));
   }
}

std::string VersionsText()
{
   std::string text;
   for (const auto &[name, version] : Versions())
   {
      text += (text.empty() ? "" : ", ") + name + " " + version;
   }
   return text;
}

std::string StepText(int step, const StepReport &report)
{
   std::ostringstream text;
   text << "step " << step << "  t " << std::setprecision(10) << report.time
        << "  dt " << std::setprecision(6) << report.dt << "  newton "
        << report.solve.newton << "  augmentations "
        << report.solve.augmentations << "  linear " << report.solve.linear
        << "  area " << report.contact_area << "  seconds "
        << std::setprecision(3) << report.seconds;
   if (report.failures + report.rejections > 0)
   {
      text << "  failed tries " << report.failures << ", inaccurate "
           << report.rejections;
   }
   return text.str();
}
} // namespace

Simulation::Simulation(const CaseFile &setup_, MPI_Comm comm_)
   : setup(Checked(setup_)), comm(comm_), mesh(ReadMesh(setup, comm)),
     problem(setup, mesh)
{
   watch.Start();
}

Simulation::~Simulation() = default;

void Simulation::Describe(std::ostream &out)
{
   const ProblemReport report(setup, problem);
   const LineOutput reachable(setup, problem.Get());
   if (IsRoot(comm))
   {
      report.Write(out);
   }
}

TimeStepper &Simulation::Stepper()
{
   if (!stepper)
   {
      TimeOptions options(setup.time);
      for (const LineCase &line : setup.output.lines)
      {
         options.stops.insert(options.stops.end(), line.times.begin(),
                              line.times.end());
      }
      stepper = std::make_unique<TimeStepper>(problem.Get(), options);
      strains = std::make_unique<StrainMonitor>(mesh, stepper->Displacement());
   }
   return *stepper;
}

bool Simulation::IsNow(real_t time)
{
   return std::abs(time - Stepper().Time()) <= same_part * setup.time.step;
}

void Simulation::WriteSetup() const
{
   const std::string path = setup.output.directory + "/case.toml";
   std::string message;
   if (IsRoot(comm))
   {
      errno = 0;
      std::ofstream file(path, std::ios::trunc);
      file << "# As it ran, with all defaults: " << VersionsText() << "\n\n";
      WriteCase(setup, file);
      file.close();
      if (!file)
      {
         message = "cannot write '" + path + "': " + std::strerror(errno);
      }
   }
   ThrowIfAny(comm, message);
}

std::string Simulation::CheckpointDirectory() const
{
   return setup.output.directory + "/checkpoint";
}

void Simulation::Say(const std::string &text)
{
   log->Add(text);
   if (progress)
   {
      progress->EndLine();
   }
   if (IsRoot(comm))
   {
      std::cout << text << std::endl;
   }
}

void Simulation::Start()
{
   if (log)
   {
      return;
   }
   // What may go wrong with files does so before the long work.
   MakeOutputDirectory(setup.output.directory, comm);
   const std::vector<PairAtStart> pairs = CheckContact(setup, problem);
   lines = std::make_unique<LineOutput>(setup, problem.Get());
   StartOutput(false);
   for (const PairAtStart &pair : pairs)
   {
      log->Add("contact pair \"" + pair.name + "\": least gap at the start " +
               ToText(pair.least_gap));
   }
   for (const FirstApproach::Move &move :
        problem.Get().Operator().Start().moves)
   {
      Say(ToText(move));
   }
   DiscardCheckpoints(CheckpointDirectory(), comm);
}

void Simulation::Restart(const std::string &file)
{
   MFEM_VERIFY(!log, "a run can't be restarted once it has begun");
   lines = std::make_unique<LineOutput>(setup, problem.Get());
   ReadCheckpoint(file, problem.Get(), Stepper());
   StartOutput(true);
   Say("goes on from t = " + ToText(stepper->Time()) + ", " + file);
}

void Simulation::Resume()
{
   const FoundCheckpoint found = FindCheckpoint(CheckpointDirectory(), comm);
   if (found.file.empty())
   {
      Start();
   }
   else
   {
      Restart(found.file);
   }
   for (const std::string &reason : found.passed_over)
   {
      Say("warning: " + reason);
   }
   if (found.file.empty())
   {
      Say("there is no checkpoint in '" + CheckpointDirectory() +
          "': begins at the start");
   }
}

void Simulation::StartOutput(bool goes_on)
{
   const std::string &directory = setup.output.directory;
   MakeOutputDirectory(directory, comm);
   log = std::make_unique<RunLog>(directory, comm, goes_on);
   WriteSetup();
   Stepper();
   // A run that goes on in another directory starts a history there.
   const bool has_history = goes_on && HasHistory(directory, comm);
   history = std::make_unique<History>(
      directory, comm,
      has_history ? std::optional<real_t>(stepper->Time()) : std::nullopt);
   if (setup.output.fields_every > 0)
   {
      fields = std::make_unique<FieldOutput>(directory, problem.Get(), *stepper,
                                             goes_on);
   }
   progress = std::make_unique<Progress>(comm);
   stop = std::make_unique<StopRequest>();

   BiphasicSpaces &spaces = problem.Get().Spaces();
   int ranks = 1;
   MPI_Comm_size(comm, &ranks);
   std::ostringstream text;
   text << "order " << spaces.Order() << ", "
        << spaces.Displacement().GlobalTrueVSize() +
              spaces.Pressure().GlobalTrueVSize()
        << " dofs on " << ranks << (ranks == 1 ? " rank" : " ranks")
        << ", set up in " << std::setprecision(3) << watch.RealTime() << " s";
   log->Add(VersionsText());
   if (!setup.title.empty())
   {
      Say(setup.title);
   }
   Say(text.str());
}

std::string Simulation::WriteCheckpoint()
{
   try
   {
      return synovia::WriteCheckpoint(CheckpointDirectory(), problem.Get(),
                                      *stepper);
   }
   catch (const Error &error) // on all ranks alike
   {
      // Those of before are still there, and the disk may get room again.
      const std::string warning = std::string("warning: ") + error.what();
      log->TryToAdd(warning);
      progress->EndLine();
      if (IsRoot(comm))
      {
         std::cerr << warning << std::endl;
      }
      return "";
   }
}

void Simulation::Fail(const StepReport &report)
{
   progress->EndLine();
   std::string text = "the step from t = " + ToText(report.time) +
                      " with dt = " + ToText(report.dt) +
                      " failed: " + report.reason;
   if (setup.output.checkpoint_every > 0 && stepper->Steps() > 0)
   {
      const std::string file = WriteCheckpoint();
      if (!file.empty())
      {
         text += "; what came before is in '" + file + "'";
      }
   }
   log->TryToAdd("error: " + text);
   throw Error(text);
}

int Simulation::StopIfAsked()
{
   if (Done() || !stop || !stop->Pending(comm))
   {
      return 0;
   }
   const std::string file = WriteCheckpoint();
   const std::string at = "stopped at t = " + ToText(stepper->Time());
   Say(file.empty() ? at + ", without a checkpoint"
                    : at + "; go on with: synovia " + setup.output.directory +
                         "/case.toml --resume");
   int signal = stop->Signal();
   MPI_Allreduce(MPI_IN_PLACE, &signal, 1, MPI_INT, MPI_MAX, comm);
   return 128 + signal;
}

StepReport Simulation::Step()
{
   Start();
   const StepReport report = stepper->Step();
   if (!report.converged)
   {
      Fail(report);
   }
   const double before = watch.RealTime();
   Record(report);
   output_seconds += watch.RealTime() - before;
   progress->Report(report, *stepper);
   return report;
}

void Simulation::Record(const StepReport &report)
{
   const StrainExtremes now = strains->Measure();
   History::Row row = StepDiagnostics(problem.Get(), *stepper, report);
   AddStrains(row, now);
   history->Add(row);
   const std::string warning = strain_record.Add(now, report.time);
   if (!warning.empty())
   {
      Say("warning: " + warning);
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
         now = now || IsNow(time);
      }
      if (now)
      {
         due.push_back(i);
      }
   }
   lines->Write(due, *stepper);
   log->Add(StepText(stepper->Steps(), report));
   const int between = setup.output.checkpoint_every;
   if (between > 0 && (stepper->Steps() % between == 0 || stepper->Done()))
   {
      WriteCheckpoint();
   }
}

int Simulation::Run()
{
   Start();
   while (!Done())
   {
      Step();
      const int status = StopIfAsked();
      if (status != 0)
      {
         return status;
      }
   }
   Finish();
   return 0;
}

void Simulation::Finish()
{
   const PhaseTimes &phases = problem.Get().Operator().Times();
   std::ostringstream text;
   text << std::fixed << std::setprecision(1) << "total " << watch.RealTime()
        << " s: linear systems " << phases.linear << " s, their set-up "
        << phases.setup << " s, contact search " << phases.search
        << " s, assembly " << phases.assembly << " s, output " << output_seconds
        << " s";
   Say(text.str());
   const std::string largest = strain_record.Summary();
   if (!largest.empty())
   {
      Say(largest);
   }
   for (const ContactPair *pair : problem.Get().Operator().Pairs())
   {
      if (!pair->HasTouched())
      {
         Say("warning: contact pair \"" + pair->Name() +
             "\" never touched; are its surfaces, the gap between them and "
             "the loads right?");
      }
   }
}

} // namespace synovia
