#include "synovia/contact/contact_options.hpp"
#include "synovia/general/error.hpp"
#include "synovia/general/text.hpp"

namespace synovia
{

using namespace mfem;

void Verify(const ContactOptions &options, const std::string &pair)
{
   const auto verify = [&](bool good, const char *what, real_t value)
   {
      if (!good)
      {
         throw Error("contact pair \"" + pair + "\": " + what + " is " +
                     ToText(value) + "; it must be positive, or 0 (derived)");
      }
   };
   verify(options.penalty >= 0.0, "penalty", options.penalty);
   verify(options.pressure_penalty >= 0.0, "pressure_penalty",
          options.pressure_penalty);
   verify(options.gap_tolerance >= 0.0, "gap_tolerance", options.gap_tolerance);
   verify(options.search_radius >= 0.0, "search_radius", options.search_radius);
   verify(options.overlap_limit >= 0.0, "overlap_limit", options.overlap_limit);
   verify(options.penalty_factor > 0.0, "penalty_factor",
          options.penalty_factor);
   verify(options.pressure_tolerance > 0.0, "pressure_tolerance",
          options.pressure_tolerance);
   verify(options.quadrature_order > 0, "quadrature_order",
          options.quadrature_order);
   verify(options.friction.coefficient >= 0.0, "friction.coefficient",
          options.friction.coefficient);
   if (!(options.friction.solid_fraction >= 0.0 &&
         options.friction.solid_fraction <= 1.0))
   {
      throw Error("contact pair \"" + pair + "\": friction.solid_fraction is " +
                  ToText(options.friction.solid_fraction) +
                  "; it must be between 0 (derived) and 1");
   }
   // Functions with kinks need a rule with positive weights.
   const IntegrationRule &rule =
      IntRules.Get(Geometry::TRIANGLE, options.quadrature_order);
   if (rule.GetWeights().Min() < 0.0)
   {
      throw Error("contact pair \"" + pair + "\": quadrature_order is " +
                  std::to_string(options.quadrature_order) +
                  ", for which MFEM's rule on triangles has negative weights; "
                  "it must be between 1 and 25, but not 3");
   }
}

} // namespace synovia
