#include "contact/contact_pair.hpp"
#include "general/reduce.hpp"

#include <algorithm>
#include <cmath>

namespace synovia
{

using namespace mfem;

namespace
{
Point3 SumOverRanks(Point3 value, MPI_Comm comm)
{
   MPI_Allreduce(MPI_IN_PLACE, value.data(), 3, MPITypeMap<real_t>::mpi_type,
                 MPI_SUM, comm);
   return value;
}

Point3 SumOfDofs(const Vector &force, const Array<int> &dofs, MPI_Comm comm)
{
   Point3 sum{{0.0, 0.0, 0.0}};
   for (const int dof : dofs)
   {
      sum[dof % 3] += force[dof];
   }
   return SumOverRanks(sum, comm);
}

// About the origin.
Point3 SumOfMoments(const Vector &force, const Vector &position,
                    const Array<int> &dofs, MPI_Comm comm)
{
   Point3 sum{{0.0, 0.0, 0.0}};
   for (const int dof : dofs)
   {
      const int x = dof - dof % 3;
      Point3 single{{0.0, 0.0, 0.0}};
      single[dof % 3] = force[dof];
      sum = Sum(sum, 1.0,
                Cross({position[x], position[x + 1], position[x + 2]}, single));
   }
   return SumOverRanks(sum, comm);
}
} // namespace

real_t ContactPair::FluidLoadSupport() const
{
   Point3 total{{0.0, 0.0, 0.0}};
   Point3 fluid{{0.0, 0.0, 0.0}};
   for (int j = 0; j < active.Size(); j++)
   {
      for (int d = 0; d < 3; d++)
      {
         total[d] += traction[j] * operators.normal_area[d][j];
         fluid[d] -= active[j] * pressure[j] * operators.normal_area[d][j];
      }
   }
   total = SumOverRanks(total, comm);
   fluid = SumOverRanks(fluid, comm);
   const real_t square = Dot(total, total);
   return square > 0.0 ? Dot(fluid, total) / square : 0.0;
}

ContactPair::Diagnostics ContactPair::Diagnose() const
{
   Diagnostics result;
   Vector momentum(operators.gap->Width());
   Vector mass(operators.jump->Width());
   momentum = 0.0;
   mass = 0.0;
   AddForces(momentum, mass);
   momentum.HostRead();
   searched_positions.HostRead();
   const Array<int> &source_dofs = source.DisplacementTrueDofs();
   const Array<int> &destination_dofs = destination.DisplacementTrueDofs();
   result.source_force = SumOfDofs(momentum, source_dofs, comm);
   result.destination_force = SumOfDofs(momentum, destination_dofs, comm);
   result.source_moment =
      SumOfMoments(momentum, searched_positions, source_dofs, comm);
   result.destination_moment =
      SumOfMoments(momentum, searched_positions, destination_dofs, comm);
   result.fluid_load_support = FluidLoadSupport();
   real_t area = 0.0;
   real_t exchange = 0.0;
   for (int j = 0; j < gap.Size(); j++)
   {
      area += active[j] * operators.area[j];
      result.penetration =
         std::max(result.penetration, active[j] * std::abs(gap[j]));
      result.pressure_jump =
         std::max(result.pressure_jump, Exchanges(j) ? std::abs(jump[j]) : 0.0);
      result.peak_traction = std::max(result.peak_traction, -traction[j]);
      result.peak_pressure =
         std::max(result.peak_pressure, sealing[j] * pressure[j]);
      exchange += operators.area[j] * flux[j];
   }
   result.area = SumOverRanks(area, comm);
   result.fluid_exchange = SumOverRanks(exchange, comm);
   result.penetration = MaxOverRanks(result.penetration, comm);
   result.pressure_jump = MaxOverRanks(result.pressure_jump, comm);
   result.peak_traction = MaxOverRanks(result.peak_traction, comm);
   result.peak_pressure = MaxOverRanks(result.peak_pressure, comm);
   return result;
}

} // namespace synovia
