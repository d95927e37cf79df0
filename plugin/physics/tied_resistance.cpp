#include "synovia/physics/tied_resistance.hpp"
#include "synovia/fem/joint_coordinates.hpp"
#include "synovia/fem/tied_nodes.hpp"

#include <algorithm>

namespace synovia
{

using namespace mfem;

TiedResistance::TiedResistance(const RigidMotions &motions,
                               BiphasicSpaces &spaces,
                               const BoundaryConditions &conditions)
{
   for (const RigidBody &body : conditions.RigidBodies())
   {
      AddBody(motions, spaces, body);
   }
   for (const Ligament &ligament : conditions.Ligaments())
   {
      AddLigament(ligament, spaces, conditions);
   }
   for (const Joint &joint : conditions.Joints())
   {
      AddJoint(joint, spaces, conditions);
   }
}

void TiedResistance::AddBody(const RigidMotions &motions,
                             BiphasicSpaces &spaces, const RigidBody &body)
{
   const TiedNodes nodes(spaces, body);
   Tied tied;
   tied.first = all_free;
   for (int i = 0; i < 6; i++)
   {
      if (body.options.IsFree(i) && body.options.stiffness[i] == 0.0)
      {
         tied.free.push_back(i);
      }
   }
   constexpr int per_body = RigidMotions::per_body;
   const int size = per_body * motions.Bodies();
   const int count = static_cast<int>(tied.free.size());
   tied.motions.SetSize(size);
   tied.motions = 0.0;
   tied.mixed.SetSize(count, size);
   tied.mixed = 0.0;
   for (const TiedNodes::Node &node : nodes.Get())
   {
      const int first = per_body * motions.BodyOf(node.dof);
      for (int d = 0; d < 3; d++)
      {
         AddSquare(motions, node.dof + d, 1.0, tied.motions);
         for (int k = 0; k < count; k++)
         {
            const real_t motion = nodes.Motion(tied.free[k], node.arm)[d];
            for (int m = 0; m < per_body; m++)
            {
               tied.mixed(k, first + m) += motion * motions.At(node.dof + d, m);
            }
         }
      }
   }
   SumOverRanks(tied.motions, spaces.GetComm());
   if (count > 0)
   {
      SumOverRanks(tied.mixed, spaces.GetComm());
   }
   tied.freedoms.SetSize(count);
   for (int j = 0; j < count; j++)
   {
      for (int i = 0; i < count; i++)
      {
         tied.freedoms(i, j) = nodes.Squares()(tied.free[i], tied.free[j]);
      }
   }
   all_free += count;
   bodies.push_back(tied);
}

void TiedResistance::AddLigament(const Ligament &ligament,
                                 BiphasicSpaces &spaces,
                                 const BoundaryConditions &conditions)
{
   const Point3 along = Sum({{0.0, 0.0, 0.0}}, 1.0 / ligament.Distance(),
                            Sum(ligament.to.point, -1.0, ligament.from.point));
   std::vector<Point3> directions{along};
   if (conditions.GetDeformation() == Deformation::finite)
   {
      directions = {{{1.0, 0.0, 0.0}}, {{0.0, 1.0, 0.0}}, {{0.0, 0.0, 1.0}}};
   }
   std::vector<Vector> rows(directions.size(), Vector(all_free));
   for (Vector &row : rows)
   {
      row = 0.0;
   }
   const std::vector<RigidBody> &known = conditions.RigidBodies();
   for (std::size_t b = 0; b < known.size(); b++)
   {
      for (const LigamentEnd *end : {&ligament.from, &ligament.to})
      {
         if (end->body != known[b].name)
         {
            continue;
         }
         const TiedNodes nodes(spaces, known[b]);
         const Point3 arm = Sum(end->point, -1.0, nodes.Reference());
         const real_t sign = end == &ligament.to ? 1.0 : -1.0;
         for (std::size_t k = 0; k < bodies[b].free.size(); k++)
         {
            const Point3 motion = nodes.Motion(bodies[b].free[k], arm);
            for (std::size_t r = 0; r < rows.size(); r++)
            {
               rows[r][bodies[b].first + static_cast<int>(k)] +=
                  sign * Dot(directions[r], motion);
            }
         }
      }
   }
   // However long the arms are.
   for (Vector &row : rows)
   {
      const real_t size = all_free > 0 ? row.Normlinf() : 0.0;
      row *= size > 0.0 ? 1.0 / size : 1.0;
   }
   ligaments.push_back(rows);
}

void TiedResistance::AddJoint(const Joint &joint, BiphasicSpaces &spaces,
                              const BoundaryConditions &conditions)
{
   std::array<BonePose, 2> bones;
   std::array<int, 2> numbers{{-1, -1}};
   std::array<real_t, 2> radii{{1.0, 1.0}};
   const std::vector<RigidBody> &known = conditions.RigidBodies();
   for (std::size_t b = 0; b < known.size(); b++)
   {
      for (int side = 0; side < 2; side++)
      {
         if ((side == 0 ? joint.proximal : joint.distal).body == known[b].name)
         {
            const TiedNodes nodes(spaces, known[b]);
            bones[side].reference = nodes.Reference();
            radii[side] = nodes.Radius();
            numbers[side] = static_cast<int>(b);
         }
      }
   }
   const auto coordinates =
      JointCoordinates(joint, bones[0], bones[1], conditions.GetDeformation());
   for (int c = 0; c < 6; c++)
   {
      Vector row(all_free);
      row = 0.0;
      for (int side = 0; joint.prescribed[c] && side < 2; side++)
      {
         const Tied *tied =
            numbers[side] < 0 ? nullptr : &bodies[numbers[side]];
         for (std::size_t k = 0; tied && k < tied->free.size(); k++)
         {
            const int freedom = tied->free[k];
            row[tied->first + static_cast<int>(k)] =
               coordinates[c].first[6 * side + freedom] /
               (freedom < 3 ? 1.0 : radii[side]);
         }
      }
      const real_t size = all_free > 0 ? row.Normlinf() : 0.0;
      if (size > 0.0)
      {
         row /= size;
         drives.push_back(row);
      }
   }
}

void TiedResistance::AddLeast(DenseMatrix part, const DenseMatrix &mixed,
                              const DenseMatrix &freedoms, DenseMatrix &sum)
{
   if (freedoms.Height() > 0)
   {
      DenseMatrix fitted(mixed.Height(), mixed.Width());
      DenseMatrixInverse(freedoms).Mult(mixed, fitted);
      DenseMatrix taken(part.Height());
      MultAtB(mixed, fitted, taken);
      // A body that goes with all that is tied to it resists only by round-off.
      constexpr real_t round_off = 1e-12;
      const real_t whole = part.MaxMaxNorm();
      part -= taken;
      if (part.MaxMaxNorm() <= round_off * whole)
      {
         part = 0.0;
      }
   }
   AddScaled(part, sum);
}

void TiedResistance::AddTo(const std::vector<bool> &resisting,
                           DenseMatrix &sum) const
{
   const bool joined =
      !drives.empty() || std::any_of(resisting.begin(), resisting.end(),
                                     [](bool is) { return is; });
   if (!joined)
   {
      for (const Tied &tied : bodies)
      {
         AddLeast(tied.motions, tied.mixed, tied.freedoms, sum);
      }
      return;
   }
   const int size = sum.Height();
   DenseMatrix motions(size);
   motions = 0.0;
   DenseMatrix mixed(all_free, size);
   mixed = 0.0;
   DenseMatrix freedoms(all_free);
   freedoms = 0.0;
   for (const Tied &tied : bodies)
   {
      // However many nodes there are.
      const real_t weight = 1.0 / tied.motions.MaxMaxNorm();
      motions.Add(weight, tied.motions);
      for (int k = 0; k < tied.mixed.Height(); k++)
      {
         for (int m = 0; m < size; m++)
         {
            mixed(tied.first + k, m) = weight * tied.mixed(k, m);
         }
         for (int i = 0; i < tied.freedoms.Height(); i++)
         {
            freedoms(tied.first + i, tied.first + k) =
               weight * tied.freedoms(i, k);
         }
      }
   }
   for (const Vector &row : drives)
   {
      AddMult_a_VVt(1.0, row, freedoms);
   }
   for (std::size_t l = 0; l < resisting.size(); l++)
   {
      for (std::size_t r = 0; resisting[l] && r < ligaments[l].size(); r++)
      {
         AddMult_a_VVt(1.0, ligaments[l][r], freedoms);
      }
   }
   AddLeast(motions, mixed, freedoms, sum);
}

} // namespace synovia
