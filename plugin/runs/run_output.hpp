#pragma once

#include "synovia/cases/case_file.hpp"
#include "synovia/io/field_output.hpp"
#include "synovia/io/history.hpp"
#include "synovia/time/time_stepper.hpp"

#include <memory>
#include <string>

namespace synovia
{

class LineOutput;

/// Whether times differ by no more than round-off does, in steps.
bool IsSameTime(mfem::real_t a, mfem::real_t b, const TimeOptions &options);

/// What a run writes of its steps: history.csv, history.h5, lines/, fields/ and
/// checkpoint/, as often as the case says. All members are collective.
class RunOutput
{
public:
   /// Borrows @a setup and @a problem. Nothing is written yet. Throws Error if
   /// a line leaves the mesh.
   RunOutput(const CaseFile &setup, BiphasicProblem &problem);
   ~RunOutput();

   /// Starts the files, or goes on with those that are there up to the
   /// stepper's time. Borrows @a stepper. Throws Error if they can't be
   /// written.
   void Open(TimeStepper &stepper, bool goes_on);

   /// Adds the row of a step to the history and writes what else is due after
   /// it, except checkpoints. Throws Error if it can't.
   void Record(const History::Row &row);
   bool CheckpointIsDue() const;
   /// Writes one now, and gives the name of its file.
   std::string WriteCheckpoint();

private:
   const CaseFile &setup;
   BiphasicProblem &problem;
   TimeStepper *stepper = nullptr;
   std::unique_ptr<LineOutput> lines;
   std::unique_ptr<History> history;
   std::unique_ptr<FieldOutput> fields;
};

} // namespace synovia
