#include "synovia/fem/ligaments.hpp"

namespace synovia
{

using namespace mfem;

Ligaments::Ligaments(const RigidTies &ties_,
                     const std::vector<Ligament> &ligaments)
   : ties(ties_)
{
   for (const Ligament &ligament : ligaments)
   {
      const auto end = [&](const LigamentEnd &at)
      {
         const int body = ties.Find(at.body);
         const Point3 arm =
            body < 0 ? at.point
                     : Sum(at.point, -1.0, ties.Nodes(body).Reference());
         return End{body, at.point, arm};
      };
      lines.push_back({ligament.name,
                       {end(ligament.from), end(ligament.to)},
                       LigamentLaw(ligament),
                       Sum(ligament.to.point, -1.0, ligament.from.point)});
   }
}

Ligaments::Reach Ligaments::ReachOf(const Line &line,
                                    const RigidPoses &poses) const
{
   Point3 opened{{0.0, 0.0, 0.0}};
   for (int e = 0; e < 2; e++)
   {
      const End &end = line.ends[e];
      if (end.body >= 0)
      {
         opened = Sum(opened, e == 0 ? -1.0 : 1.0,
                      ties.Frame(end.body, poses).Displacement(end.arm));
      }
   }
   const Point3 &meshed = line.along;
   const Point3 now = ties.IsFinite() ? Sum(meshed, 1.0, opened) : meshed;
   const Point3 direction = Sum({{0.0, 0.0, 0.0}}, 1.0 / Length(now), now);
   const real_t length =
      ties.IsFinite() ? Length(now) : Length(meshed) + Dot(direction, opened);
   return {length, direction};
}

std::vector<Ligaments::State> Ligaments::States(const RigidPoses &poses) const
{
   std::vector<State> states;
   for (const Line &line : lines)
   {
      const real_t length = ReachOf(line, poses).length;
      states.push_back({length, line.law.Force(length)});
   }
   return states;
}

std::vector<bool> Ligaments::Resisting(const RigidPoses &poses) const
{
   std::vector<bool> resisting;
   for (const Line &line : lines)
   {
      resisting.push_back(line.law.Resists(ReachOf(line, poses).length));
   }
   return resisting;
}

void Ligaments::AddForces(const RigidPoses &poses,
                          std::vector<TiedForces> &sums) const
{
   for (const Line &line : lines)
   {
      const Reach reach = ReachOf(line, poses);
      const real_t force = line.law.Force(reach.length);
      for (int e = 0; e < 2 && force != 0.0; e++)
      {
         const End &end = line.ends[e];
         if (end.body >= 0)
         {
            // Tension pulls each end towards the other one.
            const Point3 pull =
               Sum({{0.0, 0.0, 0.0}}, e == 0 ? force : -force, reach.direction);
            const Point3 arm = ties.Frame(end.body, poses).Turned(end.arm);
            sums[end.body].Add(arm, pull, ties.IsFinite());
         }
      }
   }
}

Point3 Ligaments::Opening(const Line &line, const RigidTies::Slot &slot,
                          const RigidPoses &poses) const
{
   Point3 opening{{0.0, 0.0, 0.0}};
   for (int e = 0; e < 2; e++)
   {
      const End &end = line.ends[e];
      if (end.body == slot.body)
      {
         opening =
            Sum(opening, e == 0 ? -slot.scale : slot.scale,
                ties.Frame(slot.body, poses).Motion(slot.freedom, end.arm));
      }
   }
   return opening;
}

void Ligaments::AddStiffness(const RigidPoses &poses,
                             DenseMatrix &stiffness) const
{
   const int slots = static_cast<int>(ties.Slots().size());
   for (const Line &line : lines)
   {
      const Reach reach = ReachOf(line, poses);
      const real_t along = line.law.Slope(reach.length);
      // What turns the line turns its force.
      const real_t across =
         ties.IsFinite() ? line.law.Force(reach.length) / reach.length : 0.0;
      std::vector<Point3> openings;
      for (const RigidTies::Slot &slot : ties.Slots())
      {
         openings.push_back(Opening(line, slot, poses));
      }
      for (int j = 0; j < slots; j++)
      {
         const real_t lengthening = Dot(reach.direction, openings[j]);
         for (int i = 0; i < slots; i++)
         {
            stiffness(i, j) += (along - across) *
                                  Dot(reach.direction, openings[i]) *
                                  lengthening +
                               across * Dot(openings[i], openings[j]);
         }
      }
   }
}

} // namespace synovia
