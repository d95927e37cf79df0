#include "synovia/feb/feb_steady.hpp"
#include "synovia/feb/feb_laws.hpp"
#include "synovia/materials/law_registry.hpp"
#include "synovia/materials/material_frame.hpp"

#include <algorithm>
#include <cmath>

namespace synovia
{

using namespace mfem;

namespace
{
// Part of the shortest step in which fluid leaves: less would tell pressures
// from round-off badly.
constexpr real_t part_of_step = 1e-3;

real_t AggregateModulus(const SolidCase &solid, const MaterialFrame &frame,
                        real_t solid_fraction)
{
   real_t sum = 0.0;
   for (const SolidCase &part : solid.solids)
   {
      sum += AggregateModulus(part, frame, solid_fraction);
   }
   if (solid.solids.empty())
   {
      LawArguments from{solid.parameters, frame, solid_fraction, {}};
      from.vectors = solid.vectors;
      sum = SolidLaws().Make(solid.model, from)->AggregateModulus();
   }
   return sum;
}

// The largest extent along an axis.
real_t Extent(const FebMesh &mesh)
{
   real_t extent = 0.0;
   for (int d = 0; d < 3; d++)
   {
      const auto [low, high] = std::minmax_element(
         mesh.nodes.begin(), mesh.nodes.end(),
         [d](const Point3 &a, const Point3 &b) { return a[d] < b[d]; });
      extent = std::max(extent, (*high)[d] - (*low)[d]);
   }
   return extent;
}
} // namespace

real_t MakeSteady(FebModel &model)
{
   real_t step = model.steps.ends[0];
   for (size_t i = 1; i < model.steps.ends.size(); i++)
   {
      step = std::min(step, model.steps.ends[i] - model.steps.ends[i - 1]);
   }
   const real_t extent = Extent(model.mesh);
   real_t factor = 1.0;
   for (const MaterialCase &material : model.setup.materials)
   {
      if (!material.HasFluid())
      {
         continue;
      }
      const CartesianFrame frame(material.frame.axis);
      const real_t modulus =
         AggregateModulus(material.solid, frame, material.solid_fraction);
      const real_t permeability = PermeabilityLaws()
                                     .Make(material.permeability.model,
                                           {material.permeability.parameters,
                                            frame,
                                            material.solid_fraction,
                                            {}})
                                     ->ReferenceValue();
      const real_t time = extent * extent / (modulus * permeability);
      factor = std::max(factor, time / (part_of_step * step));
   }
   // A number that is easily seen in the case.
   factor = std::pow(10.0, std::ceil(std::log10(factor)));
   for (MaterialCase &material : model.setup.materials)
   {
      if (material.HasFluid())
      {
         Scale(factor, material.permeability);
      }
   }
   return factor;
}

} // namespace synovia
