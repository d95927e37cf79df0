#include "synovia/contact/tie_diagnostics.hpp"
#include "synovia/contact/nodal_resultants.hpp"
#include "synovia/fem/node_positions.hpp"
#include "synovia/general/reduce.hpp"

namespace synovia
{

using namespace mfem;

TieDiagnostics Diagnose(const TiedInterface &tie, const Vector &u)
{
   BiphasicSpaces &spaces = tie.Source().Spaces();
   MPI_Comm comm = spaces.GetComm();
   Vector momentum(spaces.Offsets()[1]);
   Vector mass(spaces.Offsets()[2] - spaces.Offsets()[1]);
   momentum = 0.0;
   mass = 0.0;
   tie.AddForces(momentum, mass);
   momentum.HostRead();
   Vector all_positions = NodePositions(spaces.Displacement());
   all_positions += u;
   all_positions.HostRead();
   const auto moment = [&](const Array<int> &dofs)
   {
      Vector positions;
      all_positions.GetSubVector(dofs, positions);
      return SumOfMoments(momentum, positions, dofs, comm);
   };
   TieDiagnostics result;
   const Array<int> &source = tie.Source().DisplacementTrueDofs();
   const Array<int> &destination = tie.Destination().DisplacementTrueDofs();
   result.source_force = SumOfDofs(momentum, source, comm);
   result.destination_force = SumOfDofs(momentum, destination, comm);
   result.source_moment = moment(source);
   result.destination_moment = moment(destination);
   result.jumps = tie.FindViolations();
   result.fluid_exchange = SumOverRanks(
      InnerProduct(tie.Operators().pressure_area, tie.State().acting.flux),
      comm);
   return result;
}

} // namespace synovia
