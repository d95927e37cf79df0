#pragma once

#include "synovia/cases/case_file.hpp"
#include "synovia/fem/stabilized_volume.hpp"
#include "synovia/general/stop_request.hpp"
#include "synovia/io/progress.hpp"
#include "synovia/io/run_log.hpp"
#include "synovia/runs/run_directory.hpp"
#include "synovia/runs/run_output.hpp"
#include "synovia/runs/stabilization_record.hpp"
#include "synovia/runs/step_sequence.hpp"
#include "synovia/runs/strain_record.hpp"

#include <iosfwd>
#include <memory>
#include <set>
#include <string>

namespace synovia
{

class Checkpoint;
struct CaseChange;

/// A case from its mesh to its results: what `synovia CASE.toml` runs, for
/// other programs to run too, in one go or step by step.
///
/// The output directory gets history.csv, history.h5, lines/, fields/,
/// checkpoint/, run.log, and case.toml, the case with all defaults. It belongs
/// to this run from its first step to its end: another one that would write
/// there is refused, and so is a run where an earlier one left results, unless
/// it goes on with that or overwrites it. From the first step on SIGINT and
/// SIGTERM only ask it to stop. All members are collective.
class Simulation
{
public:
   /// Reads the mesh and sets the problem up; nothing is written yet. Throws
   /// Error if the case contradicts itself or doesn't fit its mesh.
   Simulation(const CaseFile &setup, MPI_Comm comm);
   ~Simulation();

   /// Writes a summary of the problem to @a out, on rank 0.
   void Describe(std::ostream &out);

   // At most one of these, before the first step. Without, the run begins at
   // the start, and throws Error if the output directory has results already.

   /// Removes what earlier runs have written into the output directory.
   void Overwrite();

   /// Lets the run go on with the newest good checkpoint of the output
   /// directory; from the start if there is none. Throws Error if the case
   /// differs from the checkpoint's case in more than title, time, solver and
   /// output, and lists the keys, or if it ends before.
   void Resume();

   /// Lets the run go on from a checkpoint, which may be of a case that differs
   /// in all that keeps the unknowns and the contact pairs: the log lists the
   /// changes. What the checkpoint's own output directory has of later times is
   /// removed; in another one a history begins, and with @a overwrite what
   /// earlier runs have written there is removed first.
   ///
   /// Throws Error if the checkpoint is damaged, of another problem, or of a
   /// time after the end.
   void Restart(const std::string &file, bool overwrite = false);

   /// Runs to the end or until it is asked to stop; gives the exit status of
   /// the program. Throws Error if a step fails or the output can't be written.
   int Run();

   /// One step with its output. Throws as Run() does.
   StepReport Step();
   bool Done() const { return sequence.IsLast() && sequence.StepIsDone(); }
   /// If a signal asked the run to stop: writes a checkpoint, says how to go
   /// on, and gives the exit status of the program; else 0. Run() does it after
   /// each step.
   int StopIfAsked();
   /// Says how long it all took; Run() does it by itself.
   void Finish();

   const CaseFile &Case() const { return setup; }
   BiphasicProblem &Problem() { return sequence.Problem().Get(); }
   /// Assembles the problem at the first call.
   /// With steps, each has another problem and stepper.
   TimeStepper &Stepper();
   /// Whether the last step ended at this time.
   bool IsNow(mfem::real_t time);

private:
   void OpenDirectory();
   void Start();
   void StartAnew();
   void GoOn(const Checkpoint &checkpoint,
             const std::vector<CaseChange> &changes);
   void Begin(bool goes_on, const std::vector<std::string> &warnings);
   void Say(const std::string &text);
   void SayStep();
   std::unique_ptr<RunOutput> MakeOutput();
   void MakeMonitors(TimeStepper &stepper);
   void BeginNextStep();
   StepReport TakeStep();
   void Record(const StepReport &report);
   std::string WriteCheckpoint();
   [[noreturn]] void Fail(const StepReport &report);
   template <typename Work>
   auto Logging(Work work) -> decltype(work());

   CaseFile setup;
   MPI_Comm comm;
   mfem::StopWatch watch;
   NamedMesh mesh;
   StepSequence sequence;
   std::unique_ptr<StrainMonitor> strains;
   StrainRecord strain_record;
   /// Null where nothing is stabilized.
   std::unique_ptr<StabilizedVolume> stabilized_volume;
   StabilizationRecord stabilization_record;
   std::unique_ptr<RunDirectory> directory;
   std::unique_ptr<RunLog> log;
   std::unique_ptr<RunOutput> output;
   std::unique_ptr<Progress> progress;
   std::unique_ptr<StopRequest> stop;
   /// Pairs that touched in an earlier step.
   std::set<std::string> touched;
   double output_seconds = 0.0;
};

} // namespace synovia
