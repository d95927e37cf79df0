#include "synovia/contact/contact_scales.hpp"
#include "synovia/contact/adjacent_layer.hpp"
#include "synovia/general/error.hpp"

#include <algorithm>

namespace synovia
{

using namespace mfem;

ContactScales FindContactScales(const std::string &pair, ParMesh &mesh,
                                const MaterialTable &materials,
                                const Array<int> &source_boundary,
                                const Array<int> &destination_boundary,
                                const ContactOptions &options)
{
   const AdjacentLayer source(mesh, source_boundary);
   const AdjacentLayer destination(mesh, destination_boundary);
   if (!(source.area > 0.0) || !(destination.area > 0.0))
   {
      throw Error("contact pair \"" + pair + "\": its " +
                  (source.area > 0.0 ? "destination" : "source") +
                  " has no faces");
   }
   const auto given_or = [](real_t given, real_t derived)
   { return given > 0.0 ? given : derived; };
   const real_t thickness = destination.Thickness();
   ContactScales scales;
   scales.softest_modulus = std::min(source.SoftestModulus(materials),
                                     destination.SoftestModulus(materials));
   scales.least_permeability =
      std::min(source.LeastPermeability(materials),
               destination.LeastPermeability(materials));
   scales.gap_tolerance = given_or(options.gap_tolerance, 1e-5 * thickness);
   scales.overlap_limit = given_or(options.overlap_limit, 0.1 * thickness);
   scales.search_radius = given_or(options.search_radius, thickness);
   return scales;
}

} // namespace synovia
