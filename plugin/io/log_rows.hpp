#pragma once

#include "synovia/io/log_definition.hpp"
#include "synovia/time/time_stepper.hpp"

#include <memory>

namespace synovia
{

/// The rows of a log at the end of a step: of each node, element or rigid body
/// its number and its values.
class LogRows
{
public:
   virtual ~LogRows() = default;

   /// This rank's rows, one after the other; of nodes several ranks may have
   /// the same. Collective.
   virtual std::vector<mfem::real_t> Collect(TimeStepper &stepper) = 0;
};

/// Borrow @a problem. Collective. Throw Error where the log names what the mesh
/// does not have.
std::unique_ptr<LogRows> MakeNodeRows(const LogDefinition &log,
                                      BiphasicProblem &problem);
std::unique_ptr<LogRows> MakeElementRows(const LogDefinition &log,
                                         BiphasicProblem &problem);
std::unique_ptr<LogRows> MakeRigidBodyRows(const LogDefinition &log,
                                           BiphasicProblem &problem);

/// Appends the values that the log asks for to a row, out of all, which are in
/// the order of LogData().
void AddLogged(const LogDefinition &log, const std::vector<mfem::real_t> &all,
               std::vector<mfem::real_t> &rows);

/// Of the log's numbers, throws Error for those that are not among this and
/// other ranks' numbers. Collective.
void VerifyLogged(const LogDefinition &log,
                  const std::vector<long long> &numbers, MPI_Comm comm);

} // namespace synovia
