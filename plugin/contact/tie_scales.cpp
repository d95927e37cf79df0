#include "synovia/contact/tie_scales.hpp"
#include "synovia/contact/adjacent_layer.hpp"
#include "synovia/general/error.hpp"

#include <algorithm>

namespace synovia
{

using namespace mfem;

namespace
{
void VerifySide(const AdjacentLayer &layer, const MaterialTable &materials,
                const std::string &side)
{
   if (!(layer.area > 0.0))
   {
      throw Error(side + " has no faces");
   }
   if (layer.IsRigid(materials))
   {
      throw Error(side + " is a rigid body; list the surface of the other side "
                         "among the surfaces of that body instead");
   }
   const int wet = layer.WithFluid(materials);
   if (wet > 0 && wet < layer.regions.Size())
   {
      throw Error(side + " has fluid in some of its regions and none in "
                         "others; make two ties of it, each with surfaces of "
                         "its own");
   }
}
} // namespace

TieScales FindTieScales(const std::string &tie, ParMesh &mesh,
                        const MaterialTable &materials,
                        const Array<int> &source_boundary,
                        const Array<int> &destination_boundary,
                        const TieOptions &options)
{
   Verify(options, tie);
   const AdjacentLayer source(mesh, source_boundary);
   const AdjacentLayer destination(mesh, destination_boundary);
   VerifySide(source, materials, "tie \"" + tie + "\": its source");
   VerifySide(destination, materials, "tie \"" + tie + "\": its destination");
   // Of the thinner layer.
   constexpr real_t reach = 0.5;
   constexpr real_t accuracy = 1e-6;
   const real_t thickness =
      std::min(source.Thickness(), destination.Thickness());
   const auto given_or = [](real_t given, real_t derived)
   { return given > 0.0 ? given : derived; };
   TieScales scales;
   scales.exchanges =
      source.WithFluid(materials) > 0 && destination.WithFluid(materials) > 0;
   scales.softest_modulus = std::min(source.SoftestModulus(materials),
                                     destination.SoftestModulus(materials));
   if (scales.exchanges)
   {
      scales.least_permeability =
         std::min(source.LeastPermeability(materials),
                  destination.LeastPermeability(materials));
   }
   scales.displacement_tolerance =
      given_or(options.displacement_tolerance, accuracy * thickness);
   scales.search_radius = given_or(options.search_radius, reach * thickness);
   return scales;
}

} // namespace synovia
