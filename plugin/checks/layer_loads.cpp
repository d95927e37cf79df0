#include "synovia/checks/layer_loads.hpp"
#include "synovia/checks/surface_measures.hpp"
#include "synovia/mesh/named_boundaries.hpp"

#include <algorithm>
#include <cmath>

namespace synovia
{

using namespace mfem;

namespace
{
// A surface whose normals cancel out to less than this has no direction.
constexpr real_t least_direction = 0.1;

/// What is known of the bodies, by their number.
class Layers
{
public:
   Layers(const CaseFile &setup_, const NamedMesh &mesh_,
          const std::vector<PairAtStart> &pairs_,
          const std::vector<Body> &bodies_,
          const std::vector<RegionMeasures> &regions)
      : setup(setup_), mesh(mesh_), pairs(pairs_), bodies(bodies_),
        thickness(bodies.size(), 0.0),
        modulus(bodies.size(), std::numeric_limits<real_t>::infinity())
   {
      for (size_t b = 0; b < bodies.size(); b++)
      {
         for (const RegionMeasures &region : regions)
         {
            if (bodies[b].regions.count(region.attribute))
            {
               thickness[b] = region.thickness;
               modulus[b] = std::min(modulus[b], region.aggregate_modulus);
            }
         }
      }
   }

   /// The first body that has one of the surfaces, or -1.
   int BodyWith(const Array<int> &surfaces) const
   {
      for (size_t b = 0; b < bodies.size(); b++)
      {
         if (bodies[b].Touches(surfaces))
         {
            return static_cast<int>(b);
         }
      }
      return -1;
   }

   /// The least of a body and of those that it may touch.
   real_t Modulus(int body) const
   {
      real_t least = modulus[body];
      for (const Partner &partner : PartnersOf(body))
      {
         least = std::min(least, modulus[partner.body]);
      }
      return least;
   }

   /// 0 if the thickness is not known.
   real_t Depth(int body) const
   {
      real_t beyond = 0.0;
      for (const Partner &partner : PartnersOf(body))
      {
         beyond = std::max(beyond, thickness[partner.body] + partner.gap);
      }
      return thickness[body] > 0.0 ? thickness[body] + beyond : 0.0;
   }

private:
   struct Partner
   {
      int body;
      real_t gap;
   };

   std::vector<Partner> PartnersOf(int body) const
   {
      std::vector<Partner> partners;
      for (size_t i = 0; i < setup.contacts.size(); i++)
      {
         const int source =
            BodyWith(NamedBoundaries(mesh, setup.contacts[i].source));
         const int destination =
            BodyWith(NamedBoundaries(mesh, setup.contacts[i].destination));
         if (body == source || body == destination)
         {
            partners.push_back(
               {body == source ? destination : source, GapOf(i)});
         }
      }
      return partners;
   }

   real_t GapOf(size_t pair) const
   {
      return pair < pairs.size() && std::isfinite(pairs[pair].least_gap)
                ? std::max(pairs[pair].least_gap, real_t(0.0))
                : 0.0;
   }

   const CaseFile &setup;
   const NamedMesh &mesh;
   const std::vector<PairAtStart> &pairs;
   const std::vector<Body> &bodies;
   std::vector<real_t> thickness;
   std::vector<real_t> modulus;
};

// The largest displacement along the mean normal; 0 if there is none.
real_t NormalDisplacement(const BoundaryCase &boundary,
                          const DirectedArea &surface)
{
   const real_t length = Length(surface.vector);
   if (length < least_direction * surface.area)
   {
      return 0.0;
   }
   real_t largest = 0.0;
   for (int d = 0; d < 3; d++)
   {
      if (boundary.displacement[d])
      {
         largest = std::max(largest, std::abs(surface.vector[d]) / length *
                                        Amplitude(*boundary.displacement[d]));
      }
   }
   return largest;
}

real_t LargestTraction(const BoundaryCase &boundary)
{
   real_t largest = 0.0;
   if (boundary.effective_traction)
   {
      largest = Amplitude(*boundary.effective_traction);
   }
   if (boundary.normal_traction)
   {
      largest = Amplitude(*boundary.normal_traction);
   }
   if (boundary.traction)
   {
      for (const LoadCurve &component : *boundary.traction)
      {
         largest = std::max(largest, Amplitude(component));
      }
   }
   return largest;
}
} // namespace

real_t Amplitude(const LoadCurve &curve)
{
   real_t largest = 0.0;
   for (const real_t time : curve.Corners())
   {
      largest = std::max(largest, std::abs(curve(time)));
   }
   return largest;
}

LayerLoads FindLayerLoads(const CaseFile &setup, CaseProblem &problem,
                          const std::vector<PairAtStart> &pairs,
                          const std::vector<Body> &bodies,
                          const std::vector<RegionMeasures> &regions)
{
   NamedMesh &mesh = problem.Get().Mesh();
   const std::vector<DirectedArea> areas = MeasureDirectedAreas(mesh);
   const Layers layers(setup, mesh, pairs, bodies, regions);
   LayerLoads loads;
   for (size_t i = 0; i < setup.boundaries.size(); i++)
   {
      const BoundaryCase &boundary = setup.boundaries[i];
      const Array<int> attributes = NamedBoundaries(mesh, boundary.surfaces);
      const int b = layers.BodyWith(attributes);
      if (b < 0)
      {
         continue;
      }
      DirectedArea surface;
      for (const int attribute : attributes)
      {
         surface.vector = Sum(surface.vector, 1.0, areas[attribute].vector);
         surface.area += areas[attribute].area;
      }
      const int number = static_cast<int>(i);
      const real_t displacement = NormalDisplacement(boundary, surface);
      const real_t depth = layers.Depth(b);
      if (displacement > 0.0 && depth > 0.0)
      {
         loads.approaches.push_back(
            {number, bodies[b].name, displacement, depth});
      }
      const real_t traction = LargestTraction(boundary);
      if (traction > 0.0)
      {
         loads.stresses.push_back(
            {number, bodies[b].name, traction, false, layers.Modulus(b)});
      }
      if (boundary.force.curve && Amplitude(*boundary.force.curve) > 0.0)
      {
         loads.stresses.push_back(
            {number, bodies[b].name,
             Amplitude(*boundary.force.curve) / surface.area, true,
             layers.Modulus(b)});
      }
   }
   return loads;
}

} // namespace synovia
