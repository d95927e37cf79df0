#pragma once

#include "cases/case_file.hpp"
#include "cases/case_problem.hpp"
#include "cases/strain_record.hpp"
#include "general/stop_request.hpp"
#include "io/field_output.hpp"
#include "io/history.hpp"
#include "io/progress.hpp"
#include "io/run_log.hpp"
#include "solvers/time_stepper.hpp"

#include <iosfwd>
#include <memory>
#include <string>

namespace synovia
{

class LineOutput;

/// A case from its mesh to its results: what `synovia CASE.toml` runs, for
/// other programs to run too, in one go or step by step.
///
/// The output directory gets history.csv, history.h5, lines/, fields/,
/// checkpoint/, run.log, and case.toml, the case with all defaults. From the
/// first step on SIGINT and SIGTERM only ask it to stop. All members are
/// collective.
class Simulation
{
public:
   /// Reads the mesh and sets the problem up; nothing is written yet. Throws
   /// Error if the case contradicts itself or doesn't fit its mesh.
   Simulation(const CaseFile &setup, MPI_Comm comm);
   ~Simulation();

   /// Writes to @a out, on rank 0, what there is to know before it runs.
   void Describe(std::ostream &out);

   /// Lets the run go on from a checkpoint instead of the start; call it before
   /// the first step. Throws Error if it is damaged or of another problem.
   void Restart(const std::string &file);
   /// The same with the newest checkpoint of the output directory that is good;
   /// from the start if there is none.
   void Resume();

   /// Runs to the end or until it is asked to stop; gives the exit status of
   /// the program. Throws Error if a step fails or the output can't be written.
   int Run();

   /// One step with its output. Throws as Run() does.
   StepReport Step();
   bool Done() const { return stepper && stepper->Done(); }
   /// If a signal asked the run to stop: writes a checkpoint, says how to go
   /// on, and gives the exit status of the program; else 0. Run() does it after
   /// each step.
   int StopIfAsked();
   /// Says how long it all took; Run() does it by itself.
   void Finish();

   const CaseFile &Case() const { return setup; }
   BiphasicProblem &Problem() { return problem.Get(); }
   /// Assembles the problem at the first call.
   TimeStepper &Stepper();
   /// Whether the last step ended at this time.
   bool IsNow(mfem::real_t time);

private:
   void Start();
   void StartOutput(bool goes_on);
   void Say(const std::string &text);
   std::string CheckpointDirectory() const;
   std::string WriteCheckpoint();
   [[noreturn]] void Fail(const StepReport &report);
   void Record(const StepReport &report);
   void WriteSetup() const;

   CaseFile setup;
   MPI_Comm comm;
   mfem::StopWatch watch;
   NamedMesh mesh;
   CaseProblem problem;
   std::unique_ptr<TimeStepper> stepper;
   std::unique_ptr<StrainMonitor> strains;
   StrainRecord strain_record;
   std::unique_ptr<RunLog> log;
   std::unique_ptr<History> history;
   std::unique_ptr<FieldOutput> fields;
   std::unique_ptr<LineOutput> lines;
   std::unique_ptr<Progress> progress;
   std::unique_ptr<StopRequest> stop;
   double output_seconds = 0.0;
};

} // namespace synovia
