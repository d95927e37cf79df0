#include "synovia/contact/contact_penalties.hpp"

#include <cmath>

namespace synovia
{

using namespace mfem;

ContactPenalties::ContactPenalties(const ContactOptions &options_,
                                   const ContactScales &scales_,
                                   const Vector &vertex_areas_)
   : options(options_), scales(scales_), vertex_areas(vertex_areas_)
{
   for (Vector *v : {&gap, &jump, &resistance, &area_resistance, &conductance})
   {
      v->SetSize(vertex_areas.Size());
      *v = 0.0;
   }
}

bool ContactPenalties::SetTimeStep(real_t dt)
{
   // Steps that end on a corner differ by round-off.
   if (std::abs(dt - time_step) <= 1e-6 * dt)
   {
      return false;
   }
   time_step = dt;
   return true;
}

void ContactPenalties::Update(const ContactCoverage &coverage,
                              const Stiffening &stiffening)
{
   const real_t modulus = scales.softest_modulus;
   for (int j = 0; j < gap.Size(); j++)
   {
      const real_t h = coverage.face_size[j];
      const real_t area = coverage.area[j];
      gap[j] = stiffening.gap * options.penalty;
      jump[j] = stiffening.jump * options.pressure_penalty;
      // As stiff on the whole where the source covers only a part.
      resistance[j] = area > 0.0 ? modulus / h * vertex_areas[j] / area : 0.0;
      area_resistance[j] = area * resistance[j];
      conductance[j] =
         area > 0.0 ? scales.least_permeability / h + h / (modulus * time_step)
                    : 0.0;
      if (options.penalty == 0.0)
      {
         gap[j] = stiffening.gap * options.penalty_factor * resistance[j];
      }
      if (options.pressure_penalty == 0.0)
      {
         jump[j] = stiffening.jump * options.penalty_factor * conductance[j];
      }
   }
}

} // namespace synovia
