#include "synovia/materials/mooney_rivlin.hpp"
#include "synovia/general/error.hpp"
#include "synovia/general/text.hpp"

namespace synovia
{

MooneyRivlin::MooneyRivlin(mfem::real_t c1_, mfem::real_t c2_, mfem::real_t k_)
   : c1(c1_), c2(c2_), k(k_)
{
   if (!(c1 >= 0.0 && c2 >= 0.0 && c1 + c2 > 0.0 && k > 0.0))
   {
      throw Error("c1, c2 and k of a Mooney-Rivlin solid are " + ToText(c1) +
                  ", " + ToText(c2) + " and " + ToText(k) +
                  "; c1 + c2 and k must be positive, c1 and c2 not negative");
   }
}

} // namespace synovia
