#include "synovia/physics/first_approach.hpp"
#include "synovia/contact/clearance.hpp"
#include "synovia/contact/distance_along.hpp"
#include "synovia/fem/rigid_motions.hpp"
#include "synovia/general/error.hpp"
#include "synovia/general/reduce.hpp"
#include "synovia/general/text.hpp"
#include "synovia/physics/rigid_resultants.hpp"

#include <algorithm>
#include <cmath>

namespace synovia
{

using namespace mfem;

namespace
{
constexpr real_t infinite = std::numeric_limits<real_t>::infinity();

// The sign that a force has when it begins to act; 0 if it never does.
real_t FirstSign(const LoadCurve &curve)
{
   for (const real_t t : curve.Corners())
   {
      if (curve(t) != 0.0)
      {
         return curve(t) > 0.0 ? 1.0 : -1.0;
      }
   }
   return 0.0;
}

class Approach
{
public:
   Approach(const std::vector<Body> &bodies_, BiphasicSpaces &spaces_,
            const BoundaryConditions &conditions_,
            const std::vector<ContactPair *> &pairs_, bool any_pushed)
      : bodies(bodies_), spaces(spaces_), conditions(conditions_),
        pairs(pairs_), motions(bodies, spaces),
        no_pressure(spaces.Pressure().GetTrueVSize())
   {
      no_pressure = 0.0;
      result.displacement.SetSize(spaces.Displacement().GetTrueVSize());
      result.displacement = 0.0;
      Vector low;
      Vector high;
      spaces.GetMesh().GetBoundingBox(low, high);
      extent = high.DistanceTo(low);
      if (any_pushed)
      {
         for (ContactPair *pair : pairs)
         {
            pair->SearchReference();
         }
      }
   }

   void Add(const DrivenSurface &surface);
   FirstApproach &&Take() { return std::move(result); }

private:
   /// The pair that touches after a translation, if any.
   struct Meeting
   {
      int pair = -1;
      real_t distance = infinite;
   };

   Meeting Meet(const PushedBodies &group);
   Meeting FindNearest(const PushedBodies &group, Clearance &all);
   real_t DistanceFromAfar(const ContactPair &pair,
                           const PushedBodies &group) const;
   void Translate(real_t distance, const PushedBodies &group);
   bool Holds(int body, const Point3 &along) const;
   /// With all bodies that are tied to rigid bodies that these are tied to.
   std::set<int> WithTied(std::set<int> group) const;
   std::set<int> BodiesOf(const ContactSurface &surface) const;
   /// Those of a pair's bodies that aren't in the group.
   std::set<int> MetBy(const PushedBodies &group,
                       const ContactPair &pair) const;
   [[noreturn]] void ThrowNothingMet(const PushedBodies &group) const;

   const std::vector<Body> &bodies;
   BiphasicSpaces &spaces;
   const BoundaryConditions &conditions;
   std::vector<ContactPair *> pairs;
   RigidMotions motions;
   Vector no_pressure;
   /// Size of the mesh (length).
   real_t extent;
   FirstApproach result;
};

bool Approach::Holds(int body, const Point3 &along) const
{
   for (const RigidBody &rigid : conditions.RigidBodies())
   {
      if (bodies[body].Touches(rigid.boundary) &&
          synovia::Holds(conditions, rigid, along))
      {
         return true;
      }
   }
   constexpr real_t round_off = 1e-10;
   const Vector translation = motions.Translation({body}, along);
   real_t most = 0.0;
   for (const int dof : conditions.DisplacementDofs())
   {
      most = std::max(most, std::abs(translation[dof]));
   }
   for (const SpringFoundation &springs : conditions.Springs())
   {
      Vector force(translation.Size());
      Vector magnitude(translation.Size());
      Vector one(translation.Size());
      one = 1.0;
      springs.Matrix().Mult(1.0, translation, 0.0, force);
      springs.Matrix().AbsMult(1.0, one, 0.0, magnitude);
      const real_t scale = MaxOverRanks(
         magnitude.Size() > 0 ? magnitude.Normlinf() : 0.0, spaces.GetComm());
      most = std::max(most, force.Size() > 0 ? force.Normlinf() / scale : 0.0);
   }
   return AnyRank(most > round_off, spaces.GetComm());
}

std::set<int> Approach::WithTied(std::set<int> group) const
{
   std::size_t before = 0;
   while (group.size() > before)
   {
      before = group.size();
      for (const RigidBody &rigid : conditions.RigidBodies())
      {
         const auto is_tied = [&](int body)
         { return bodies[body].Touches(rigid.boundary); };
         const bool any = std::any_of(group.begin(), group.end(), is_tied);
         for (int b = 0; any && b < static_cast<int>(bodies.size()); b++)
         {
            if (is_tied(b))
            {
               group.insert(b);
            }
         }
      }
   }
   return group;
}

std::set<int> Approach::BodiesOf(const ContactSurface &surface) const
{
   std::vector<int> on(bodies.size(), 0);
   for (const int dof : surface.DisplacementTrueDofs())
   {
      on[motions.BodyOf(dof)] = 1;
   }
   MPI_Allreduce(MPI_IN_PLACE, on.data(), static_cast<int>(on.size()), MPI_INT,
                 MPI_MAX, spaces.GetComm());
   std::set<int> found;
   for (size_t b = 0; b < on.size(); b++)
   {
      if (on[b])
      {
         found.insert(static_cast<int>(b));
      }
   }
   return found;
}

std::set<int> Approach::MetBy(const PushedBodies &group,
                              const ContactPair &pair) const
{
   std::set<int> met;
   for (const ContactSurface *side :
        {&pair.Geometry().Source(), &pair.Geometry().Destination()})
   {
      for (const int body : BodiesOf(*side))
      {
         if (group.bodies.count(body) == 0)
         {
            met.insert(body);
         }
      }
   }
   return met;
}

real_t Approach::DistanceFromAfar(const ContactPair &pair,
                                  const PushedBodies &group) const
{
   const auto moves = [&](const ContactSurface &surface)
   {
      const std::set<int> on = BodiesOf(surface);
      return std::any_of(on.begin(), on.end(),
                         [&](int body)
                         { return group.bodies.count(body) > 0; });
   };
   const bool source_moves = moves(pair.Geometry().Source());
   if (source_moves == moves(pair.Geometry().Destination()))
   {
      return infinite;
   }
   return source_moves
             ? DistanceAlong(pair.Geometry().Source(),
                             pair.Geometry().Destination(), group.along, extent)
             : DistanceAlong(pair.Geometry().Destination(),
                             pair.Geometry().Source(), group.along, extent);
}

Approach::Meeting Approach::FindNearest(const PushedBodies &group,
                                        Clearance &all)
{
   Meeting nearest;
   for (size_t i = 0; i < pairs.size(); i++)
   {
      pairs[i]->Enforcement().Evaluate(result.displacement, no_pressure);
      Clearance clearance = FindClearance(*pairs[i], group.translation);
      if (clearance.ahead == infinite)
      {
         clearance.ahead = DistanceFromAfar(*pairs[i], group);
      }
      if (clearance.ahead < nearest.distance)
      {
         nearest = {static_cast<int>(i), clearance.ahead};
      }
      all.TakeLess(clearance);
   }
   return nearest;
}

void Approach::Translate(real_t distance, const PushedBodies &group)
{
   result.displacement.Add(distance, group.translation);
   for (ContactPair *pair : pairs)
   {
      pair->SearchAt(result.displacement);
   }
}

Approach::Meeting Approach::Meet(const PushedBodies &group)
{
   // Partners change on the way, and rays from points see a round surface
   // somewhat late.
   constexpr int most_looks = 20;
   Meeting meeting;
   real_t gone = 0.0;
   for (int look = 0; look < most_looks; look++)
   {
      Clearance clearance;
      const Meeting nearest = FindNearest(group, clearance);
      if (nearest.pair < 0)
      {
         break;
      }
      meeting = {nearest.pair, gone};
      const real_t near = pairs[nearest.pair]->Scales().gap_tolerance;
      const bool starts_in_touch =
         gone == 0.0 && clearance.touches && nearest.distance >= -near;
      // Out of an overlap, but not into another one.
      const real_t step =
         std::max(nearest.distance, -std::max(0.0, clearance.behind));
      if (starts_in_touch || std::abs(step) <= near)
      {
         break;
      }
      Translate(step, group);
      gone += step;
      meeting.distance = gone;
   }
   return meeting;
}

void Approach::ThrowNothingMet(const PushedBodies &group) const
{
   std::string names;
   for (const int body : group.bodies)
   {
      names += (names.empty() ? "\"" : " and \"") + bodies[body].name + "\"";
   }
   throw Error("nothing resists the force on \"" + group.name +
               "\": along it, (" + ToText(group.along[0]) + ", " +
               ToText(group.along[1]) + ", " + ToText(group.along[2]) + "), " +
               names +
               " meets no surface of a contact pair; check the force's "
               "direction and sign and the surfaces of the pairs, or hold " +
               names + " along it by another support or by springs");
}

void Approach::Add(const DrivenSurface &surface)
{
   PushedBodies group;
   group.name = surface.name;
   group.curve = surface.curve;
   group.sense = FirstSign(surface.curve);
   for (int d = 0; d < 3; d++)
   {
      // Without the sign of zero.
      group.along[d] = group.sense * surface.direction[d] + 0.0;
   }
   for (size_t b = 0; b < bodies.size(); b++)
   {
      if (bodies[b].Touches(surface.boundary))
      {
         group.bodies.insert(static_cast<int>(b));
      }
   }
   group.bodies = WithTied(group.bodies);
   const auto holds = [&](int body) { return Holds(body, group.along); };
   if (group.sense == 0.0 ||
       std::any_of(group.bodies.begin(), group.bodies.end(), holds))
   {
      return;
   }
   bool goes_on = true;
   for (bool first = true; goes_on; first = false)
   {
      group.translation = motions.Translation(group.bodies, group.along);
      const Meeting meeting = Meet(group);
      if (meeting.pair < 0)
      {
         if (first)
         {
            ThrowNothingMet(group);
         }
         break;
      }
      const ContactPair &pair = *pairs[meeting.pair];
      if (meeting.distance != 0.0)
      {
         result.moves.push_back({group.name, meeting.distance, pair.Name()});
      }
      const std::set<int> met = WithTied(MetBy(group, pair));
      goes_on = !met.empty() && std::none_of(met.begin(), met.end(), holds);
      if (goes_on)
      {
         group.bodies.insert(met.begin(), met.end());
      }
   }
   result.pushed.push_back(group);
}
} // namespace

FirstApproach MakeFirstApproach(const std::vector<Body> &bodies,
                                BiphasicSpaces &spaces,
                                const BoundaryConditions &conditions,
                                const std::vector<ContactPair *> &pairs)
{
   std::vector<DrivenSurface> pushing = conditions.DrivenSurfaces();
   const std::vector<DrivenSurface> rigid = FindRigidResultants(conditions);
   pushing.insert(pushing.end(), rigid.begin(), rigid.end());
   Approach approach(bodies, spaces, conditions, pairs, !pushing.empty());
   for (const DrivenSurface &surface : pushing)
   {
      approach.Add(surface);
   }
   return approach.Take();
}

std::string ToText(const FirstApproach::Move &move)
{
   const std::string length = ToText(std::abs(move.distance));
   return "what the force on \"" + move.name + "\" moves was moved by " +
          length +
          (move.distance > 0.0 ? " along it, until it touches: "
                               : " against it, out of an overlap: ") +
          "contact pair \"" + move.pair + "\"";
}

} // namespace synovia
