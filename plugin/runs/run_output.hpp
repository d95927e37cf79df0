#pragma once

#include "synovia/cases/case_steps.hpp"
#include "synovia/io/field_output.hpp"
#include "synovia/io/history.hpp"
#include "synovia/time/time_stepper.hpp"

#include <memory>
#include <string>

namespace synovia
{

class LineOutput;
class LogTables;

/// Whether times differ by no more than round-off does, in steps.
bool IsSameTime(mfem::real_t a, mfem::real_t b, const TimeOptions &options);

/// What a run writes of its steps: history.csv, history.h5, lines/, logs/,
/// fields/ and checkpoint/, as often as the case says. All members are
/// collective.
class RunOutput
{
public:
   /// Of one step of a case, whose text is @a text. Borrows @a step and @a
   /// problem. Nothing is written yet. Throws Error if a line leaves the mesh,
   /// or a log names what it does not have.
   RunOutput(const CaseOfStep &step, BiphasicProblem &problem,
             const std::string &text);
   ~RunOutput();

   /// Starts the files, or goes on with those that are there up to the
   /// stepper's time. Borrows @a stepper. Throws Error if they can't be
   /// written.
   void Open(TimeStepper &stepper, bool goes_on);

   /// Adds the row of a step to the history and writes what else is due after
   /// it, except checkpoints. Throws Error if it can't.
   void Record(const History::Row &row);
   bool CheckpointIsDue() const;
   /// Writes one now, and gives the name of its file; at the end of a step it
   /// stays under the step's name.
   std::string WriteCheckpoint();

private:
   const CaseOfStep &step;
   const CaseFile &setup;
   BiphasicProblem &problem;
   std::string text;
   TimeStepper *stepper = nullptr;
   std::unique_ptr<LineOutput> lines;
   std::unique_ptr<LogTables> logs;
   std::unique_ptr<History> history;
   std::unique_ptr<FieldOutput> fields;
};

} // namespace synovia
