#include "synovia/physics/stage_method.hpp"

namespace synovia
{

StageMethod::StageMethod(BiphasicSpaces &spaces_, StageEquations &equations_,
                         StageContact &contact_, const ToleranceRule &rule_,
                         NewtonDirection &direction_,
                         const BiphasicLinearSolver &linear_,
                         const NonlinearOptions &options_, SolveRecord &record_)
   : spaces(spaces_), equations(equations_), contact(contact_), rule(rule_),
     direction(direction_), linear(linear_), options(options_), record(record_)
{
}

} // namespace synovia
