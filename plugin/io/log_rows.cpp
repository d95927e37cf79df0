#include "synovia/io/log_rows.hpp"
#include "synovia/fem/rigid_frame.hpp"
#include "synovia/general/error.hpp"
#include "synovia/general/root_rank.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace synovia
{

using namespace mfem;

namespace
{
/// Rigid bodies, numbered from 1 in the order in which they were added; rank 0
/// has the rows.
class RigidBodyRows : public LogRows
{
public:
   RigidBodyRows(const LogDefinition &log_, BiphasicProblem &problem_)
      : log(log_), problem(problem_)
   {
   }

   std::vector<real_t> Collect(TimeStepper &) override
   {
      const RigidTies &ties = problem.Operator().Equations().Ties();
      std::vector<real_t> rows;
      int number = 0;
      for (const BiphasicProblem::RigidBodyState &body :
           problem.RigidBodyStates())
      {
         const Point3 &reference = ties.Nodes(number).Reference();
         number++;
         if (IsAsked(body.name) && IsRoot(problem.Mesh().GetComm()))
         {
            rows.push_back(number);
            AddLogged(log, ValuesOf(body, reference), rows);
         }
      }
      return rows;
   }

private:
   bool IsAsked(const std::string &name) const
   {
      return log.rigid_bodies.empty() ||
             std::find(log.rigid_bodies.begin(), log.rigid_bodies.end(),
                       name) != log.rigid_bodies.end();
   }
   static std::vector<real_t>
   ValuesOf(const BiphasicProblem::RigidBodyState &body,
            const Point3 &reference)
   {
      const Point3 place = Sum(reference, 1.0, TranslationOf(body.pose));
      const Point3 theta = RotationOf(body.pose);
      const real_t angle = Length(theta);
      const real_t share =
         angle > 0.0 ? std::sin(0.5 * angle) / angle : real_t(0.5);
      return {place[0],
              place[1],
              place[2],
              share * theta[0],
              share * theta[1],
              share * theta[2],
              std::cos(0.5 * angle),
              body.force[0],
              body.force[1],
              body.force[2],
              body.moment[0],
              body.moment[1],
              body.moment[2]};
   }

   const LogDefinition &log;
   BiphasicProblem &problem;
};
} // namespace

std::unique_ptr<LogRows> MakeRigidBodyRows(const LogDefinition &log,
                                           BiphasicProblem &problem)
{
   return std::make_unique<RigidBodyRows>(log, problem);
}

void AddLogged(const LogDefinition &log, const std::vector<real_t> &all,
               std::vector<real_t> &rows)
{
   const std::vector<std::string> &names = LogData(log.of);
   for (const std::string &name : log.data)
   {
      const auto place = std::find(names.begin(), names.end(), name);
      MFEM_VERIFY(place != names.end(),
                  "there is no \"" << name << "\" to log");
      rows.push_back(all[place - names.begin()]);
   }
}

void VerifyLogged(const LogDefinition &log,
                  const std::vector<long long> &numbers, MPI_Comm comm)
{
   std::vector<int> found(log.numbers.size());
   for (size_t i = 0; i < found.size(); i++)
   {
      found[i] = std::find(numbers.begin(), numbers.end(), log.numbers[i]) !=
                 numbers.end();
   }
   MPI_Allreduce(MPI_IN_PLACE, found.data(), static_cast<int>(found.size()),
                 MPI_INT, MPI_MAX, comm);
   const auto missing = std::find(found.begin(), found.end(), 0);
   if (missing != found.end())
   {
      throw Error("the mesh file has no " +
                  std::string(log.of == LogSubject::nodes
                                 ? "corner of an element"
                                 : "element") +
                  " with the number " +
                  std::to_string(log.numbers[missing - found.begin()]));
   }
}

} // namespace synovia
