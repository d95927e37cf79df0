#include "synovia/checks/contact_hints.hpp"
#include "synovia/general/text_table.hpp"

#include <algorithm>
#include <cmath>

namespace synovia
{

using namespace mfem;

namespace
{
// Sides that differ by less are as good as each other.
constexpr real_t clear_margin = 1.5;
// Facets that miss the surface by less than this part of how far bodies
// approach change the force by a few times as much.
constexpr real_t tolerable_part = 0.01;

std::string Names(const std::vector<std::string> &names)
{
   std::string text;
   for (const std::string &name : names)
   {
      text += (text.empty() ? "\"" : ", \"") + name + '"';
   }
   return text;
}

std::string Where(const CaseFile &setup, size_t pair, const std::string &key)
{
   return WhereIs(setup.places, "contact." + std::to_string(pair) + "." + key) +
          ": ";
}

void AdviseOnSides(const CaseFile &setup, size_t pair,
                   const ContactSides &sides, std::vector<std::string> &hints)
{
   if (sides.source.edge == 0.0 || sides.destination.edge == 0.0)
   {
      return;
   }
   const real_t coarser = sides.destination.edge / sides.source.edge;
   const real_t stiffer = sides.destination.modulus / sides.source.modulus;
   const bool wrong_way = std::max(coarser, stiffer) > clear_margin &&
                          std::min(coarser, stiffer) > 1.0 / clear_margin;
   if (wrong_way)
   {
      const ContactCase &contact = setup.contacts[pair];
      hints.push_back(
         Where(setup, pair, "destination") + Names(contact.source) +
         " would be the better destination, and " + Names(contact.destination) +
         " the source: the destination carries the contact traction, and is "
         "best the side with the finer mesh (mean edges " +
         Quantity(sides.destination.edge) + " now and " +
         Quantity(sides.source.edge) +
         " then) or of the softer body (aggregate moduli " +
         Quantity(sides.destination.modulus) + " and " +
         Quantity(sides.source.modulus) + ")");
   }
}

// How far the bodies of a pair approach each other once they touch; 0 if that
// isn't known.
real_t Approach(const LayerLoads &loads, const PairAtStart &pair,
                const std::vector<std::string> &bodies, real_t thickness)
{
   const auto is_one = [&](const std::string &body)
   { return std::find(bodies.begin(), bodies.end(), body) != bodies.end(); };
   const real_t gap = std::isfinite(pair.least_gap)
                         ? std::max(pair.least_gap, real_t(0.0))
                         : 0.0;
   real_t approach = 0.0;
   for (const LayerApproach &load : loads.approaches)
   {
      if (is_one(load.body))
      {
         approach = std::max(approach, load.displacement - gap);
      }
   }
   for (const LayerStress &load : loads.stresses)
   {
      if (is_one(load.body))
      {
         approach = std::max(approach, thickness * load.stress / load.modulus);
      }
   }
   return approach;
}

void AdviseOnFacets(const CaseFile &setup, size_t pair,
                    const ContactSides &sides, real_t approach,
                    std::vector<std::string> &hints)
{
   const real_t missed = sides.source.sagitta + sides.destination.sagitta;
   if (approach <= 0.0 || missed < tolerable_part * approach)
   {
      return;
   }
   const bool source = sides.source.sagitta > sides.destination.sagitta;
   const ContactSide &worse = source ? sides.source : sides.destination;
   const ContactCase &contact = setup.contacts[pair];
   hints.push_back(
      Where(setup, pair, source ? "source" : "destination") + "the faces of " +
      Names(source ? contact.source : contact.destination) +
      " are flat where the surface is round: with edges of " +
      Quantity(worse.edge) + " and a radius of " + Quantity(worse.Radius()) +
      " both sides miss it by " + Quantity(missed) + " (h^2/(8 R)), " +
      Quantity(100.0 * missed / approach) + " % of an approach of " +
      Quantity(approach) +
      ", which changes the force by about as much; elements of second "
      "order (Mesh.ElementOrder = 2 in gmsh) follow the surface, finer ones "
      "come nearer");
}

// Names and thickness of the bodies of a pair.
std::vector<std::string> BodiesOf(const ContactCase &contact,
                                  const NamedMesh &mesh,
                                  const std::vector<Body> &bodies)
{
   Array<int> surfaces;
   for (const auto *names : {&contact.source, &contact.destination})
   {
      for (const std::string &name : *names)
      {
         surfaces.Append(mesh.Boundary(name));
      }
   }
   std::vector<std::string> found;
   for (const Body &body : bodies)
   {
      if (body.Touches(surfaces))
      {
         found.push_back(body.name);
      }
   }
   return found;
}

real_t LeastThickness(const std::vector<RegionMeasures> &regions)
{
   real_t least = std::numeric_limits<real_t>::infinity();
   for (const RegionMeasures &region : regions)
   {
      if (region.thickness > 0.0)
      {
         least = std::min(least, region.thickness);
      }
   }
   return std::isfinite(least) ? least : 0.0;
}
} // namespace

std::vector<std::string>
FindContactHints(const CaseFile &setup, CaseProblem &problem,
                 const std::vector<PairAtStart> &pairs,
                 const std::vector<Body> &bodies,
                 const std::vector<RegionMeasures> &regions)
{
   const std::vector<ContactSides> sides =
      MeasureContactSides(setup, problem, pairs);
   const LayerLoads loads =
      FindLayerLoads(setup, problem, pairs, bodies, regions);
   std::vector<std::string> hints;
   for (size_t i = 0; i < sides.size(); i++)
   {
      AdviseOnSides(setup, i, sides[i], hints);
      const real_t approach =
         Approach(loads, pairs[i],
                  BodiesOf(setup.contacts[i], problem.Get().Mesh(), bodies),
                  LeastThickness(regions));
      AdviseOnFacets(setup, i, sides[i], approach, hints);
   }
   return hints;
}

} // namespace synovia
