#include "synovia/checks/loose_bodies.hpp"
#include "synovia/checks/contact_grip.hpp"
#include "synovia/general/text_table.hpp"
#include "synovia/mesh/named_boundaries.hpp"
#include "synovia/physics/rigid_freedoms.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace synovia
{

using namespace mfem;

namespace
{
// Surfaces that are apart by more than this part of a layer don't touch yet.
constexpr real_t touching = 0.01;

Array<int> SurfacesOf(const ContactCase &contact, const NamedMesh &mesh)
{
   Array<int> surfaces = NamedBoundaries(mesh, contact.source);
   surfaces.Append(NamedBoundaries(mesh, contact.destination));
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

// Why a body may not touch anything; empty if it does.
std::string WhyApart(const CaseFile &setup, const NamedMesh &mesh,
                     const std::vector<PairAtStart> &pairs, const Body &body,
                     const std::vector<RegionMeasures> &regions)
{
   const real_t gap = LeastGap(setup, mesh, pairs, body);
   if (gap <= touching * ThicknessOf(body, regions))
   {
      return "";
   }
   return std::isfinite(gap)
             ? "which it doesn't touch yet: the least gap is " + Quantity(gap)
             : "and its surfaces don't see any others";
}

std::vector<int> BodiesIn(const Vector &motion)
{
   std::vector<int> moving;
   for (int b = 0; b < motion.Size() / RigidMotions::per_body; b++)
   {
      if (Vector(motion.GetData() + RigidMotions::per_body * b,
                 RigidMotions::per_body)
             .Normlinf() > 0.0)
      {
         moving.push_back(b);
      }
   }
   return moving;
}

// Words of a sentence: a, b and c.
std::string Listed(const std::vector<std::string> &words)
{
   std::string text;
   for (size_t i = 0; i < words.size(); i++)
   {
      text += (i == 0 ? "" : i + 1 < words.size() ? ", " : " and ") + words[i];
   }
   return text;
}

// Directions of free motion, by the bodies that move together and the reason.
class LooseDirections
{
public:
   LooseDirections(const std::vector<Body> &bodies_,
                   const RigidMotions &motions_)
      : bodies(bodies_), motions(motions_)
   {
   }

   // An empty reason: there isn't even contact.
   void Add(const Vector &motion, const std::string &why)
   {
      const std::vector<int> moving = BodiesIn(motion);
      directions[{moving, why}].push_back(
         motions
            .Direction(moving.front(),
                       motion.GetData() +
                          RigidMotions::per_body * moving.front())
            .text);
   }

   std::vector<std::string> Sentences() const
   {
      std::vector<std::string> sentences;
      for (const auto &[loose, along] : directions)
      {
         const auto &[moving, why] = loose;
         std::vector<std::string> names;
         for (const int b : moving)
         {
            names.push_back("\"" + bodies[b].name + "\"");
         }
         sentences.push_back(
            (why.empty() ? "nothing holds " : "only contact holds ") +
            Listed(names) + " " + Listed(along) +
            (why.empty() ? "" : ", " + why) + "; prescribe " +
            (along.size() > 1 ? "displacements" : "that displacement") +
            " on one of its surfaces, or add springs");
      }
      return sentences;
   }

private:
   const std::vector<Body> &bodies;
   const RigidMotions &motions;
   std::map<std::pair<std::vector<int>, std::string>, std::vector<std::string>>
      directions;
};
} // namespace

std::vector<std::string>
FindLooseBodies(const CaseFile &setup, CaseProblem &problem,
                const std::vector<PairAtStart> &pairs,
                const std::vector<Body> &bodies,
                const std::vector<RegionMeasures> &regions)
{
   BiphasicSpaces &spaces = problem.Get().Spaces();
   const NamedMesh &mesh = problem.Get().Mesh();
   const RigidFreedoms freedoms(
      bodies, RigidMotions(bodies, spaces, ContactSurfaces(setup, mesh)),
      spaces, problem.Get().Conditions());
   const std::vector<Vector> free = freedoms.WithoutContact();
   if (free.empty())
   {
      return {};
   }
   const ContactGrip grip(setup, problem, bodies, freedoms.Motions());
   LooseDirections loose(bodies, freedoms.Motions());
   const ContactGrip::Motions split = grip.Split(free);
   for (const Vector &motion : split.sliding)
   {
      const std::vector<int> moving = BodiesIn(motion);
      const bool in_contact =
         std::any_of(moving.begin(), moving.end(),
                     [&](int body) { return grip.HasContact(body); });
      loose.Add(motion,
                in_contact ? "which can't, as there is no friction" : "");
   }
   for (const Vector &motion : split.resisted)
   {
      const int body = BodiesIn(motion).front();
      if (grip.FromOneSide(motion) && !grip.IsLoaded(body, motion))
      {
         loose.Add(motion,
                   "from one side, and no load presses it against that");
         continue;
      }
      const std::string apart =
         WhyApart(setup, mesh, pairs, bodies[body], regions);
      if (!grip.IsDriven(body, motion) && !apart.empty())
      {
         loose.Add(motion, apart);
      }
   }
   return loose.Sentences();
}

} // namespace synovia
