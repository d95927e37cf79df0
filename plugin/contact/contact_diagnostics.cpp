#include "synovia/contact/contact_diagnostics.hpp"
#include "synovia/contact/contact_area.hpp"
#include "synovia/contact/nodal_resultants.hpp"
#include "synovia/general/reduce.hpp"

#include <algorithm>
#include <cmath>

namespace synovia
{

using namespace mfem;

namespace
{
// Stiffness against closing a gap, relative to that of the softer body: each
// side gives way by half.
constexpr real_t closing_part = 0.5;

FrictionDiagnostics DiagnoseFriction(const ContactPair &pair)
{
   const ContactState &state = pair.State();
   const ContactCoverage &coverage = pair.Constraint().Coverage();
   FrictionDiagnostics result;
   Point3 normal{{0.0, 0.0, 0.0}};
   real_t touching = 0.0;
   real_t sliding = 0.0;
   for (int j = 0; j < state.gap.Size(); j++)
   {
      for (int d = 0; d < 3; d++)
      {
         result.force[d] += coverage.area[j] * state.friction.traction[d][j];
         normal[d] += coverage.normal_area[d][j] * state.traction[j];
      }
      touching += state.vertices[j].touches ? coverage.area[j] : 0.0;
      sliding += state.friction.vertices[j].slides ? coverage.area[j] : 0.0;
   }
   MPI_Comm comm = pair.Geometry().Source().Spaces().GetComm();
   result.force = SumOverRanks(result.force, comm);
   const real_t pressed = Length(SumOverRanks(normal, comm));
   result.coefficient = pressed > 0.0 ? Length(result.force) / pressed : 0.0;
   touching = SumOverRanks(touching, comm);
   sliding = SumOverRanks(sliding, comm);
   result.sliding = touching > 0.0 ? sliding / touching : 0.0;
   result.dissipation = SumOverRanks(state.friction.dissipation, comm);
   return result;
}

real_t FluidLoadSupport(const ContactPair &pair)
{
   const ContactState &state = pair.State();
   const std::array<Vector, 3> &normal_area =
      pair.Constraint().Coverage().normal_area;
   const std::array<Vector, 3> &present = pair.Constraint().PresentNormalArea();
   Point3 total{{0.0, 0.0, 0.0}};
   Point3 fluid{{0.0, 0.0, 0.0}};
   for (int j = 0; j < state.gap.Size(); j++)
   {
      for (int d = 0; d < 3; d++)
      {
         total[d] += state.traction[j] * normal_area[d][j];
         if (state.vertices[j].touches)
         {
            fluid[d] -= state.pressure[j] * present[d][j];
         }
      }
   }
   MPI_Comm comm = pair.Geometry().Source().Spaces().GetComm();
   total = SumOverRanks(total, comm);
   fluid = SumOverRanks(fluid, comm);
   const real_t square = Dot(total, total);
   return square > 0.0 ? Dot(fluid, total) / square : 0.0;
}
} // namespace

Vector PresentTraction(const ContactPair &pair)
{
   Vector traction(pair.State().traction);
   const Vector &area = pair.Constraint().Coverage().area;
   const Vector &present = pair.Constraint().PresentArea();
   for (int j = 0; j < traction.Size(); j++)
   {
      traction[j] *= traction[j] != 0.0 ? area[j] / present[j] : 0.0;
   }
   return traction;
}

Vector PresentFriction(const ContactPair &pair)
{
   const ContactState &state = pair.State();
   const Vector &area = pair.Constraint().Coverage().area;
   const Vector &present = pair.Constraint().PresentArea();
   Vector friction(area.Size());
   for (int j = 0; j < friction.Size(); j++)
   {
      friction[j] = state.rubs && state.vertices[j].touches
                       ? Length(FrictionState::At(state.friction.traction, j)) *
                            area[j] / present[j]
                       : 0.0;
   }
   return friction;
}

real_t ContactArea(const ContactPair &pair)
{
   const ContactState &state = pair.State();
   const Vector &resistance = pair.Enforcement().Penalties().Resistance();
   const std::vector<FaceCoverage> &coverage =
      pair.Constraint().Coverage().face_coverage;
   Vector stress = VertexMeans(pair.Geometry().Destination(), coverage,
                               PresentTraction(pair));
   for (int j = 0; j < stress.Size(); j++)
   {
      if (!state.vertices[j].touches)
      {
         stress[j] +=
            closing_part * resistance[j] * std::max<real_t>(state.gap[j], 0.0);
      }
   }
   return NegativeArea(pair.Geometry().Destination(), coverage, stress);
}

bool HasTouched(const ContactPair &pair)
{
   return AnyRank(pair.State().touched,
                  pair.Geometry().Source().Spaces().GetComm());
}

ContactDiagnostics Diagnose(const ContactPair &pair)
{
   const BiphasicSpaces &spaces = pair.Geometry().Source().Spaces();
   MPI_Comm comm = spaces.GetComm();
   ContactDiagnostics result;
   Vector momentum(spaces.Offsets()[1]);
   Vector mass(spaces.Offsets()[2] - spaces.Offsets()[1]);
   momentum = 0.0;
   mass = 0.0;
   pair.AddForces(momentum, mass);
   momentum.HostRead();
   const Array<int> &source_dofs =
      pair.Geometry().Source().DisplacementTrueDofs();
   const Array<int> &destination_dofs =
      pair.Geometry().Destination().DisplacementTrueDofs();
   result.source_force = SumOfDofs(momentum, source_dofs, comm);
   result.destination_force = SumOfDofs(momentum, destination_dofs, comm);
   result.source_moment = SumOfMoments(
      momentum, pair.Geometry().SourcePositions(), source_dofs, comm);
   result.destination_moment = SumOfMoments(
      momentum, pair.Geometry().DestinationPositions(), destination_dofs, comm);
   result.fluid_load_support = FluidLoadSupport(pair);
   if (pair.State().rubs)
   {
      result.friction = DiagnoseFriction(pair);
   }
   result.area = ContactArea(pair);
   const ContactViolations violations = pair.Enforcement().FindViolations();
   result.penetration = violations.penetration;
   result.pressure_jump = violations.pressure_jump;
   const ContactState &state = pair.State();
   const Vector traction = PresentTraction(pair);
   real_t exchange = 0.0;
   for (int j = 0; j < state.gap.Size(); j++)
   {
      result.peak_traction = std::max(result.peak_traction, -traction[j]);
      if (state.vertices[j].seals)
      {
         result.peak_pressure =
            std::max(result.peak_pressure, state.pressure[j]);
      }
      exchange += pair.Constraint().Coverage().area[j] * state.flux[j];
   }
   result.fluid_exchange = SumOverRanks(exchange, comm);
   result.peak_traction = MaxOverRanks(result.peak_traction, comm);
   result.peak_pressure = MaxOverRanks(result.peak_pressure, comm);
   return result;
}

} // namespace synovia
