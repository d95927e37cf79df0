#include "synovia/materials/permeability_law.hpp"
#include "synovia/general/error.hpp"
#include "synovia/general/text.hpp"

namespace synovia
{

ConstantPermeability::ConstantPermeability(mfem::real_t value_) : value(value_)
{
   if (!(value > 0.0))
   {
      throw Error("the permeability is " + ToText(value) +
                  "; it must be positive");
   }
}

} // namespace synovia
