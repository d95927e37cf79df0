#include "synovia/materials/deforming_permeability.hpp"
#include "synovia/general/error.hpp"
#include "synovia/general/text.hpp"

namespace synovia
{

using namespace mfem;

namespace
{
// Written such that a NaN does not pass either.
void Verify(bool good, const std::string &name, real_t value,
            const std::string &must)
{
   if (!good)
   {
      throw Error(name + " is " + ToText(value) + "; it must be " + must);
   }
}
} // namespace

DeformingPermeability::DeformingPermeability(real_t value_) : value(value_)
{
   Verify(value > 0.0, "the permeability", value, "positive");
}

HolmesMowPermeability::HolmesMowPermeability(real_t value_, real_t m_,
                                             real_t alpha_,
                                             real_t solid_fraction_)
   : DifferentiatedPermeability(value_), m(m_), alpha(alpha_),
     solid_fraction(solid_fraction_)
{
   Verify(m >= 0.0, "M of a permeability", m, "0 or positive");
   Verify(alpha >= 0.0, "alpha of a permeability", alpha, "0 or positive");
   Verify(solid_fraction > 0.0 && solid_fraction < 1.0, "the solid fraction",
          solid_fraction, "between 0 and 1");
}

} // namespace synovia
