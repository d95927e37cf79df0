#include "synovia/contact/contact_pair.hpp"
#include "synovia/general/reduce.hpp"

#include <algorithm>
#include <cmath>

namespace synovia
{

using namespace mfem;

namespace
{
// What it takes to close a gap, of what the softer body resists alone: half
// of it gives way on each side.
constexpr real_t closing_part = 0.5;

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

real_t ContactPair::Area() const
{
   const std::vector<FaceCoverage> &coverage = operators.face_coverage;
   Vector stress = VertexMeans(destination, coverage, traction);
   for (int j = 0; j < stress.Size(); j++)
   {
      if (active[j] < 0.5)
      {
         stress[j] +=
            closing_part * resistance[j] * std::max<real_t>(gap[j], 0.0);
      }
   }
   return NegativeArea(destination, coverage, stress);
}

ContactPair::Violations ContactPair::WorstViolations() const
{
   Violations worst;
   for (int j = 0; j < gap.Size(); j++)
   {
      worst.penetration =
         std::max(worst.penetration, active[j] * std::abs(gap[j]));
      worst.pressure_jump =
         std::max(worst.pressure_jump, Exchanges(j) ? std::abs(jump[j]) : 0.0);
   }
   worst.penetration = MaxOverRanks(worst.penetration, comm);
   worst.pressure_jump = MaxOverRanks(worst.pressure_jump, comm);
   return worst;
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
   result.area = Area();
   const Violations violations = WorstViolations();
   result.penetration = violations.penetration;
   result.pressure_jump = violations.pressure_jump;
   real_t exchange = 0.0;
   for (int j = 0; j < gap.Size(); j++)
   {
      result.peak_traction = std::max(result.peak_traction, -traction[j]);
      result.peak_pressure =
         std::max(result.peak_pressure, sealing[j] * pressure[j]);
      exchange += operators.area[j] * flux[j];
   }
   result.fluid_exchange = SumOverRanks(exchange, comm);
   result.peak_traction = MaxOverRanks(result.peak_traction, comm);
   result.peak_pressure = MaxOverRanks(result.peak_pressure, comm);
   return result;
}

} // namespace synovia
