#include "synovia/runs/simulation.hpp"
#include "synovia/cases/case_mesh.hpp"
#include "synovia/checks/case_warnings.hpp"
#include "synovia/checks/contact_check.hpp"
#include "synovia/contact/contact_diagnostics.hpp"
#include "synovia/general/root_rank.hpp"
#include "synovia/general/text.hpp"
#include "synovia/general/version.hpp"
#include "synovia/io/checkpoint.hpp"
#include "synovia/io/checkpoint_directory.hpp"
#include "synovia/io/step_diagnostics.hpp"
#include "synovia/runs/problem_report.hpp"
#include "synovia/runs/restart_rules.hpp"
#include "synovia/runs/resume_command.hpp"
#include "synovia/runs/run_texts.hpp"
#include "synovia/runs/step_table.hpp"

#include <iostream>

namespace synovia
{

using namespace mfem;

namespace
{
const CaseFile &Checked(const CaseFile &setup)
{
   CheckCase(setup);
   return setup;
}
} // namespace

Simulation::Simulation(const CaseFile &setup_, MPI_Comm comm_)
   : setup(Checked(setup_)), comm(comm_), mesh(ReadCaseMesh(setup, comm)),
     sequence(setup, mesh), strain_record(setup.space.deformation)
{
   watch.Start();
}

Simulation::~Simulation() = default;

void Simulation::Describe(std::ostream &out)
{
   const ProblemReport report(sequence.Present().setup, sequence.Problem());
   const std::unique_ptr<RunOutput> possible = MakeOutput();
   if (IsRoot(comm))
   {
      report.Write(out);
      WriteSteps(setup, out);
   }
}

TimeStepper &Simulation::Stepper()
{
   TimeStepper &stepper = sequence.Stepper();
   if (!strains)
   {
      MakeMonitors(stepper);
   }
   return stepper;
}

void Simulation::MakeMonitors(TimeStepper &stepper)
{
   Array<int> rigid;
   for (const int region : mesh.Get().attributes)
   {
      if (Problem().Materials().Get(region).IsRigid())
      {
         rigid.Append(region);
      }
   }
   strains = std::make_unique<StrainMonitor>(mesh, stepper.Displacement(),
                                             setup.space.deformation, rigid);
   const VolumeMatrices &matrices =
      Problem().Operator().Equations().Bodies().Tangent();
   if (matrices.stabilization)
   {
      stabilized_volume = std::make_unique<StabilizedVolume>(
         mesh, Problem().Spaces(), Problem().Materials(),
         *matrices.stabilization);
   }
}

bool Simulation::IsNow(real_t time)
{
   return IsSameTime(time, Stepper().Time(), setup.time);
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

void Simulation::SayStep()
{
   if (!setup.steps.empty())
   {
      Say(BeginText(sequence.Present()));
   }
}

std::unique_ptr<RunOutput> Simulation::MakeOutput()
{
   return std::make_unique<RunOutput>(sequence.Present(), Problem(),
                                      SetupText(setup));
}

void Simulation::OpenDirectory()
{
   MFEM_VERIFY(!log, "the run has begun already");
   if (!directory)
   {
      directory = std::make_unique<RunDirectory>(setup.output.directory, comm);
   }
}

void Simulation::Start()
{
   if (!log)
   {
      OpenDirectory();
      directory->VerifyUnused();
      StartAnew();
   }
}

void Simulation::Overwrite()
{
   OpenDirectory();
   StartAnew();
}

void Simulation::StartAnew()
{
   // Errors of the case come before anything is removed.
   const CaseFile &first = sequence.Present().setup;
   const std::vector<PairAtStart> pairs =
      CheckContact(first, sequence.Problem());
   const std::vector<TieAtStart> ties = CheckTies(first, sequence.Problem());
   const std::vector<std::string> warnings =
      FindWarnings(first, sequence.Problem(), pairs);
   output = MakeOutput();
   directory->Clear();
   Begin(false, warnings);
   for (const PairAtStart &pair : pairs)
   {
      log->Add("contact pair \"" + pair.name + "\": least gap at the start " +
               ToText(pair.least_gap));
   }
   for (const TieAtStart &tie : ties)
   {
      log->Add("tie \"" + tie.name + "\": points that are tied are up to " +
               ToText(tie.distance) + " apart");
   }
   for (const std::string &hint : FindTieHints(first, ties))
   {
      Say("hint: " + hint);
   }
   for (const FirstApproach::Move &move : Problem().Operator().Start().moves)
   {
      Say(ToText(move));
   }
}

void Simulation::Resume()
{
   OpenDirectory();
   const FoundCheckpoint found = FindCheckpoint(directory->Checkpoints(), comm);
   if (!found.file.empty())
   {
      const Checkpoint checkpoint(found.file, comm);
      GoOn(checkpoint, ChangesToResume(setup, checkpoint));
   }
   else
   {
      if (directory->IsUsed())
      {
         VerifySameProblem(setup, directory->ReadSetup(),
                           setup.output.directory);
      }
      StartAnew();
      Say("there is no checkpoint in '" + directory->Checkpoints() +
          "': begins at the start");
   }
   for (const std::string &reason : found.passed_over)
   {
      Say("warning: " + reason);
   }
}

void Simulation::Restart(const std::string &file, bool overwrite)
{
   OpenDirectory();
   const Checkpoint checkpoint(file, comm);
   const bool same_directory = directory->HasCheckpoint(file);
   if (same_directory && overwrite)
   {
      throw Error("to overwrite '" + setup.output.directory +
                  "' would remove the checkpoint '" + file +
                  "'; name another directory with --output");
   }
   if (!same_directory && !overwrite)
   {
      directory->VerifyUnused();
   }
   GoOn(checkpoint, ChangesToRestart(setup, checkpoint));
   if (checkpoint.Setup().empty())
   {
      Say("warning: the checkpoint does not hold its case, for it is of an "
          "older version: what has changed is not known");
   }
}

void Simulation::GoOn(const Checkpoint &checkpoint,
                      const std::vector<CaseChange> &changes)
{
   VerifyEnd(setup, checkpoint);
   sequence.GoTo(checkpoint.Time());
   const std::vector<std::string> warnings =
      FindWarnings(sequence.Present().setup, sequence.Problem(), {});
   output = MakeOutput();
   checkpoint.Restore(Problem(), Stepper());
   if (directory->HasCheckpoint(checkpoint.File()))
   {
      directory->ClearAfter(checkpoint.Time(), checkpoint.Steps(),
                            sequence.NamesToReach());
   }
   else
   {
      directory->Clear();
   }
   Begin(true, warnings);
   Say("goes on from t = " + ToText(Stepper().Time()) + ", " +
       checkpoint.File());
   for (const CaseChange &change : changes)
   {
      Say("changed: " + ToText(change));
   }
}

void Simulation::Begin(bool goes_on, const std::vector<std::string> &warnings)
{
   log = std::make_unique<RunLog>(setup.output.directory, comm, goes_on);
   directory->WriteSetup(setup);
   Logging([&]() { output->Open(Stepper(), goes_on); });
   progress = std::make_unique<Progress>(comm);
   stop = std::make_unique<StopRequest>();

   log->Add(VersionsText());
   if (!setup.title.empty())
   {
      Say(setup.title);
   }
   Say(SizeText(Problem().Spaces(), watch.RealTime()));
   SayStep();
   if (!directory->Doubt().empty())
   {
      Say("warning: " + directory->Doubt());
   }
   for (const std::string &warning : warnings)
   {
      Say("warning: " + warning);
   }
}

template <typename Work>
auto Simulation::Logging(Work work) -> decltype(work())
{
   try
   {
      return work();
   }
   catch (const std::exception &error)
   {
      if (progress)
      {
         progress->EndLine();
      }
      log->TryToAdd(std::string("error: ") + error.what());
      throw;
   }
}

std::string Simulation::WriteCheckpoint()
{
   try
   {
      return output->WriteCheckpoint();
   }
   catch (const Error &error) // on all ranks alike
   {
      // Earlier checkpoints are still there, and the disk may get room again.
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
   std::string text = "the step from t = " + ToText(report.time) +
                      " with dt = " + ToText(report.dt) +
                      " failed: " + report.reason;
   if (setup.output.checkpoint_every > 0 && Stepper().Steps() > 0)
   {
      // The end of the step before has been written.
      const std::string file =
         sequence.IsAtBeginning()
            ? CheckpointName(directory->Checkpoints(), Stepper().Steps())
            : WriteCheckpoint();
      if (!file.empty())
      {
         text += "; what came before is in '" + file + "'";
      }
   }
   throw Error(text);
}

int Simulation::StopIfAsked()
{
   if (Done() || !stop || !stop->Pending(comm))
   {
      return 0;
   }
   const std::string file = WriteCheckpoint();
   const std::string at = "stopped at t = " + ToText(Stepper().Time());
   if (file.empty())
   {
      Say(at + ", without a checkpoint");
   }
   else
   {
      Say(at + "; go on with:");
      Say(ResumeCommand(setup.output.directory, comm));
   }
   int signal = stop->Signal();
   MPI_Allreduce(MPI_IN_PLACE, &signal, 1, MPI_INT, MPI_MAX, comm);
   return 128 + signal;
}

StepReport Simulation::Step()
{
   Start();
   return Logging([&]() { return TakeStep(); });
}

void Simulation::BeginNextStep()
{
   for (const ContactPair *pair : Problem().Operator().Pairs())
   {
      if (HasTouched(*pair))
      {
         touched.insert(pair->Name());
      }
   }
   // They look at what the step had.
   output.reset();
   strains.reset();
   stabilized_volume.reset();
   sequence.Advance();
   output = MakeOutput();
   output->Open(Stepper(), true);
   SayStep();
   const real_t jump = sequence.Jump();
   if (jump > 0.0)
   {
      Say("warning: " + JumpText(jump));
   }
}

StepReport Simulation::TakeStep()
{
   if (sequence.StepIsDone())
   {
      BeginNextStep();
   }
   const StepReport report = Stepper().Step();
   if (!report.converged)
   {
      Fail(report);
   }
   const double before = watch.RealTime();
   Record(report);
   output_seconds += watch.RealTime() - before;
   progress->Report(report, sequence.StepsLeft());
   return report;
}

void Simulation::Record(const StepReport &report)
{
   const StrainExtremes now = strains->Measure();
   History::Row row = StepDiagnostics(Problem(), Stepper(), report);
   AddStrains(row, now);
   if (!setup.steps.empty())
   {
      row.emplace_back("step", sequence.Number());
   }
   output->Record(row);
   std::vector<std::string> warnings{strain_record.Add(now, report.time)};
   if (stabilized_volume)
   {
      Vector p;
      Stepper().Pressure().GetTrueDofs(p);
      warnings.push_back(stabilization_record.Add(
         stabilized_volume->FindLargest(p), report.time));
   }
   for (const std::string &warning : warnings)
   {
      if (!warning.empty())
      {
         Say("warning: " + warning);
      }
   }
   log->Add(StepText(Stepper().Steps(), report));
   if (output->CheckpointIsDue())
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
   Say(PhaseText(sequence.Times(), watch.RealTime(), output_seconds));
   for (const std::string &largest :
        {strain_record.Summary(), stabilization_record.Summary()})
   {
      if (!largest.empty())
      {
         Say(largest);
      }
   }
   for (const ContactPair *pair : Problem().Operator().Pairs())
   {
      if (!HasTouched(*pair) && touched.count(pair->Name()) == 0)
      {
         Say("warning: contact pair \"" + pair->Name() +
             "\" never touched; are its surfaces, the gap between them and "
             "the loads right?");
      }
   }
}

} // namespace synovia
