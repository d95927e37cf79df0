#include "synovia/contact/contact_scales.hpp"
#include "synovia/contact/adjacent_layer.hpp"
#include "synovia/general/error.hpp"

#include <algorithm>

namespace synovia
{

using namespace mfem;

namespace
{
bool HasFluid(const AdjacentLayer &layer, const MaterialTable &materials,
              const std::string &pair, const std::string &side)
{
   const int wet = layer.WithFluid(materials);
   if (wet > 0 && wet < layer.regions.Size())
   {
      throw Error("contact pair \"" + pair + "\": some of the regions of its " +
                  side + " have fluid and others don't; make two pairs of it");
   }
   return wet > 0;
}
} // namespace

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
   if (destination.IsRigid(materials))
   {
      throw Error(
         "contact pair \"" + pair +
         "\": its destination is a rigid body; the destination carries "
         "the contact traction and must deform, make the rigid body "
         "the source");
   }
   const auto given_or = [](real_t given, real_t derived)
   { return given > 0.0 ? given : derived; };
   const real_t thickness = destination.Thickness();
   ContactScales scales;
   scales.softest_modulus = std::min(source.SoftestModulus(materials),
                                     destination.SoftestModulus(materials));
   scales.solid_fraction =
      given_or(options.friction.solid_fraction,
               source.LargestSolidFraction(materials) *
                  destination.LargestSolidFraction(materials));
   const bool wet_source = HasFluid(source, materials, pair, "source");
   const bool wet_destination =
      HasFluid(destination, materials, pair, "destination");
   if (wet_source || wet_destination)
   {
      scales.least_permeability =
         std::min(source.LeastPermeability(materials),
                  destination.LeastPermeability(materials));
   }
   scales.fluid = wet_source && wet_destination ? FluidSides::both
                  : wet_source                  ? FluidSides::source
                  : wet_destination             ? FluidSides::destination
                                                : FluidSides::none;
   scales.gap_tolerance = given_or(options.gap_tolerance, 1e-5 * thickness);
   scales.overlap_limit = given_or(options.overlap_limit, 0.1 * thickness);
   scales.search_radius = given_or(options.search_radius, thickness);
   return scales;
}

} // namespace synovia
