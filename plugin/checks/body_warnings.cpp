#include "synovia/checks/body_warnings.hpp"
#include "synovia/checks/body_shape.hpp"
#include "synovia/checks/contact_grip.hpp"
#include "synovia/general/text_table.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace synovia
{

using namespace mfem;

namespace
{
// Surfaces that are apart by more than this part of a layer don't touch yet.
constexpr real_t touching = 0.01;

Array<int> SurfacesOf(const ContactCase &contact, const NamedMesh &mesh)
{
   Array<int> surfaces;
   for (const auto *names : {&contact.source, &contact.destination})
   {
      for (const std::string &name : *names)
      {
         surfaces.Append(mesh.Boundary(name));
      }
   }
   return surfaces;
}

// Of the pairs that a body is in; 0 if they are not known.
real_t LeastGap(const CaseFile &setup, const NamedMesh &mesh,
                const std::vector<PairAtStart> &pairs, const Body &body)
{
   real_t least = std::numeric_limits<real_t>::infinity();
   for (size_t i = 0; i < pairs.size(); i++)
   {
      if (body.Touches(SurfacesOf(setup.contacts[i], mesh)))
      {
         least = std::min(least, pairs[i].least_gap);
      }
   }
   return pairs.empty() ? 0.0 : least;
}

real_t ThicknessOf(const Body &body, const std::vector<RegionMeasures> &regions)
{
   for (const RegionMeasures &region : regions)
   {
      if (body.regions.count(region.attribute))
      {
         return region.thickness;
      }
   }
   return 0.0;
}

// Why contact does not hold a body along an axis; empty if it does.
std::string WhyLoose(const ContactGrip &grip, int axis, real_t gap,
                     real_t thickness)
{
   if (!grip.pushes_up[axis] && !grip.pushes_down[axis])
   {
      return "which can't, as there is no friction";
   }
   if (grip.pushes_up[axis] != grip.pushes_down[axis] && !grip.loaded[axis])
   {
      return "from one side, and no load presses it against that";
   }
   if (!grip.driven[axis] && gap > touching * thickness)
   {
      return std::isfinite(gap)
                ? "which it doesn't touch yet: the least gap is " +
                     Quantity(gap)
                : "and its surfaces don't see any others";
   }
   return "";
}
} // namespace

std::vector<std::string>
FindBodyWarnings(const CaseFile &setup, CaseProblem &problem,
                 const std::vector<PairAtStart> &pairs,
                 const std::vector<Body> &bodies,
                 const std::vector<RegionMeasures> &regions)
{
   NamedMesh &mesh = problem.Get().Mesh();
   const Array<int> draining = DrainingSurfaces(setup, mesh);
   const char *const axes[3] = {"x", "y", "z"};
   const Array<int> held[3] = {HeldSurfaces(setup, mesh, 0),
                               HeldSurfaces(setup, mesh, 1),
                               HeldSurfaces(setup, mesh, 2)};
   const std::vector<ContactGrip> grips = FindContactGrips(setup, mesh, bodies);
   std::vector<std::string> warnings;
   for (size_t b = 0; b < bodies.size(); b++)
   {
      const Body &body = bodies[b];
      if (!body.Touches(draining))
      {
         warnings.push_back(WhereIs(setup.places, "boundary") +
                            ": no fluid can leave \"" + body.name +
                            "\": it has no surface with a pressure or in a "
                            "contact pair");
      }
      const real_t gap = LeastGap(setup, mesh, pairs, body);
      for (int d = 0; d < 3; d++)
      {
         const std::string why =
            WhyLoose(grips[b], d, gap, ThicknessOf(body, regions));
         if (!body.Touches(held[d]) && !why.empty())
         {
            warnings.push_back(WhereIs(setup.places, "boundary") +
                               ": only contact holds \"" + body.name +
                               "\" along " + axes[d] + ", " + why +
                               "; prescribe that displacement on one of its "
                               "surfaces, or add springs");
         }
      }
   }
   return warnings;
}

} // namespace synovia
