#include "synovia/materials/solids/continuous_fiber_distribution.hpp"
#include "synovia/general/error.hpp"

namespace synovia
{

using namespace mfem;

namespace
{
const FiberEnergy &FibersOf(const LawArguments &from)
{
   const FiberEnergy *const fibers =
      from.parts.size() == 1
         ? dynamic_cast<const FiberEnergy *>(from.parts.front())
         : nullptr;
   if (!fibers)
   {
      throw Error("a distribution is made of one law of fibers, such as "
                  "fiber_pow");
   }
   return *fibers;
}

std::vector<WeightedDirection> RuleOf(const FiberDensity &density)
{
   const LawDescription law = ContinuousFiberDistribution::Describe();
   law.Verify({density.concentration});
   law.vectors[0].Verify(density.semiaxes);
   return density.Rule();
}
} // namespace

LawDescription ContinuousFiberDistribution::Describe()
{
   LawDescription law{
      "continuous_fiber_distribution",
      "fibers of another law in all directions, by a density",
      Deformation::finite,
      {{"b", "", "the concentration b of the fibers about theta",
        NumberRange::From(0.0, 100.0), 0.0}}};
   law.vectors = {{"spa", "",
                   "the semiaxes spa of the density along r, theta, z",
                   NumberRange::Positive(), Point3{{1.0, 1.0, 1.0}}}};
   law.has_fibers = true;
   return law;
}

ContinuousFiberDistribution::ContinuousFiberDistribution(
   const LawArguments &from)
   : ContinuousFiberDistribution(FibersOf(from),
                                 {from["b"], from.Vector("spa")}, from.frame)
{
}

ContinuousFiberDistribution::ContinuousFiberDistribution(
   const FiberEnergy &fibers_, const FiberDensity &density,
   const MaterialFrame &frame)
   : FiberDistribution(RuleOf(density), frame), fibers(fibers_)
{
   if (!fibers.DependsOnStretchOnly())
   {
      throw Error("the fibers of a distribution resist tension only; set their "
                  "shear modulus mu to 0");
   }
}

} // namespace synovia
