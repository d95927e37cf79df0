#pragma once

#include "synovia/physics/biphasic_problem.hpp"

namespace synovia
{

/// What the first contact pair of a problem transmits.
struct TractionMoments
{
   /// Resultant of the normal traction, positive in compression.
   mfem::real_t force = 0.0;
   /// Mean of x^2 + y^2, weighted by the traction.
   mfem::real_t mean_square_radius = 0.0;
};

/// Collective.
TractionMoments MeasureTraction(BiphasicProblem &problem);

} // namespace synovia
