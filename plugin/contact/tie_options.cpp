#include "synovia/contact/tie_options.hpp"
#include "synovia/general/error.hpp"
#include "synovia/general/text.hpp"

namespace synovia
{

using namespace mfem;

void Verify(const TieOptions &options, const std::string &tie)
{
   const auto verify =
      [&](bool good, const char *what, real_t value, const char *range)
   {
      if (!good)
      {
         throw Error("tie \"" + tie + "\": " + what + " is " + ToText(value) +
                     "; it must be positive" + range);
      }
   };
   const char *const derived = ", or 0 (derived)";
   verify(options.search_radius >= 0.0, "search_radius", options.search_radius,
          derived);
   verify(options.displacement_tolerance >= 0.0, "displacement_tolerance",
          options.displacement_tolerance, derived);
   verify(options.pressure_tolerance > 0.0, "pressure_tolerance",
          options.pressure_tolerance, "");
}

} // namespace synovia
