#include "synovia/runs/step_sequence.hpp"
#include "synovia/general/error.hpp"
#include "synovia/general/reduce.hpp"
#include "synovia/io/state_snapshot.hpp"

#include <cmath>

namespace synovia
{

using namespace mfem;

namespace
{
// Times that differ by this factor are the same.
constexpr real_t same_time = 1.0 + 1e-9;
} // namespace

StepSequence::StepSequence(const CaseFile &setup, NamedMesh &mesh_)
   : steps(CasesOfSteps(setup)), mesh(mesh_)
{
   // Errors of all steps come before the first one.
   for (size_t i = 1; i < steps.size(); i++)
   {
      Begin(i);
   }
   Begin(0);
}

void StepSequence::Begin(size_t step)
{
   stepper.reset();
   problem.reset();
   present = step;
   try
   {
      problem = std::make_unique<CaseProblem>(Present().setup, mesh);
   }
   catch (const Error &error) // on all ranks alike
   {
      throw Error(steps.size() == 1 ? error.what()
                                    : error.what() + ("\n  in the step \"" +
                                                      Present().name + "\""));
   }
}

TimeStepper &StepSequence::Stepper()
{
   if (!stepper)
   {
      TimeOptions options(Present().setup.time);
      options.begin = Present().begin;
      options.end = Present().end;
      for (const LineCase &line : Present().setup.output.lines)
      {
         options.stops.insert(options.stops.end(), line.times.begin(),
                              line.times.end());
      }
      stepper = std::make_unique<TimeStepper>(problem->Get(), options);
   }
   return *stepper;
}

std::vector<std::string> StepSequence::NamesToReach()
{
   std::vector<std::string> names;
   for (size_t i = present; i < steps.size(); i++)
   {
      if (i > present || !Stepper().Done())
      {
         names.push_back(steps[i].name);
      }
   }
   return names;
}

PhaseTimes StepSequence::Times() const
{
   PhaseTimes all(spent);
   all += problem->Get().Operator().Times();
   return all;
}

int StepSequence::StepsLeft() const
{
   int left = stepper ? stepper->StepsLeft() : 0;
   for (size_t i = present + 1; i < steps.size(); i++)
   {
      const real_t duration = steps[i].end - steps[i].begin;
      left += CountSteps(steps[i].setup.time, duration);
   }
   return left;
}

bool StepSequence::IsAtBeginning()
{
   return present > 0 && Stepper().Time() <= Present().begin * same_time;
}

real_t StepSequence::Jump()
{
   // Of the largest displacement.
   constexpr real_t round_off = 1e-9;
   MPI_Comm comm = mesh.GetComm();
   const Vector &u = Stepper().State().GetBlock(0);
   Vector prescribed(u);
   problem->Get().Conditions().SetDisplacement(Stepper().Time(), prescribed);
   prescribed -= u;
   const real_t jump = MaxOverRanks(prescribed.Normlinf(), comm);
   return jump > round_off * MaxOverRanks(u.Normlinf(), comm) ? jump : 0.0;
}

void StepSequence::GoTo(real_t time)
{
   size_t step = 0;
   while (step + 1 < steps.size() && time > steps[step].end * same_time)
   {
      step++;
   }
   if (step != present)
   {
      Begin(step);
   }
}

void StepSequence::Advance()
{
   MFEM_VERIFY(StepIsDone() && !IsLast(), "there is no next step yet");
   spent = Times();
   StateSnapshot state;
   stepper->Archive(state);
   state.Rewind();
   Begin(present + 1);
   Stepper().Archive(state);
   stepper->BeginAnew();
}

} // namespace synovia
