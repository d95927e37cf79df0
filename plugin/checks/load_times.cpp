#include "synovia/checks/load_times.hpp"

#include <algorithm>

namespace synovia
{

using namespace mfem;

namespace
{
void Add(const LoadCurve &curve, LoadTimes &loads)
{
   const std::vector<real_t> &times = curve.Corners();
   for (size_t i = 1; i < times.size(); i++)
   {
      if (curve(times[i]) != curve(times[i - 1]))
      {
         const real_t duration = times[i] - times[i - 1];
         loads.shortest = std::min(loads.shortest, duration);
         loads.longest = std::max(loads.longest, duration);
         loads.last = std::max(loads.last, times[i]);
      }
   }
}

void Add(const std::optional<LoadCurve> &curve, LoadTimes &loads)
{
   if (curve)
   {
      Add(*curve, loads);
   }
}
} // namespace

LoadTimes FindLoadTimes(const CaseFile &setup)
{
   LoadTimes loads;
   for (const BoundaryCase &boundary : setup.boundaries)
   {
      for (int d = 0; d < 3; d++)
      {
         Add(boundary.displacement[d], loads);
         if (boundary.traction)
         {
            Add((*boundary.traction)[d], loads);
         }
      }
      Add(boundary.pressure, loads);
      Add(boundary.normal_traction, loads);
      Add(boundary.effective_traction, loads);
      Add(boundary.normal_flux, loads);
      Add(boundary.mixture_flux, loads);
      Add(boundary.force.curve, loads);
   }
   for (const Joint &joint : setup.joints)
   {
      for (const std::optional<LoadCurve> &curve : joint.prescribed)
      {
         Add(curve, loads);
      }
   }
   for (const RigidBodyCase &body : setup.rigid_bodies)
   {
      const RigidBodyOptions options = body.Options();
      for (int i = 0; i < 6; i++)
      {
         Add(options.prescribed[i], loads);
         Add(options.load[i], loads);
      }
   }
   return loads;
}

} // namespace synovia
