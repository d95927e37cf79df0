#include "synovia/linalg/multiplier_system.hpp"

namespace synovia
{

using namespace mfem;

MultiplierSystem::MultiplierSystem(const BiphasicJacobian &jacobian_,
                                   real_t pressure_scale_, real_t compliance_)
   : Operator(jacobian_.Height() + Rows(jacobian_)), jacobian(jacobian_),
     pressure_scale(pressure_scale_), compliance(compliance_)
{
   int begin = jacobian.Height();
   for (const ContactFactors &factors : jacobian.Contact())
   {
      if (factors.gap_values)
      {
         const int size = factors.gap->Height();
         blocks.push_back({factors, begin, size});
         begin += 2 * size;
      }
   }
}

int MultiplierSystem::Rows(const BiphasicJacobian &jacobian)
{
   int rows = 0;
   for (const ContactFactors &factors : jacobian.Contact())
   {
      rows += factors.gap_values ? 2 * factors.gap->Height() : 0;
   }
   return rows;
}

void MultiplierSystem::Scale(real_t pressures, real_t outflows, Vector &v) const
{
   Vector pressure_part(v, jacobian.Offsets()[1],
                        jacobian.Height() - jacobian.Offsets()[1]);
   pressure_part *= pressures;
   for (const Block &block : blocks)
   {
      Vector jumps = block.Jumps(v);
      jumps *= outflows;
   }
}

void MultiplierSystem::Weigh(real_t weight, Vector &rows) const
{
   for (const Block &block : blocks)
   {
      Vector gaps = block.Gaps(rows);
      gaps *= weight;
      Vector jumps = block.Jumps(rows);
      jumps *= weight;
   }
}

void MultiplierSystem::AddLoads(real_t scale, Vector &v, Vector &y) const
{
   const int split = jacobian.Offsets()[1];
   Vector forces(split);
   Vector volumes(jacobian.Height() - split);
   forces = 0.0;
   volumes = 0.0;
   for (const Block &block : blocks)
   {
      block.factors.gap->MultTranspose(1.0, block.Gaps(v), 1.0, forces);
      block.factors.jump->MultTranspose(1.0, block.Jumps(v), 1.0, volumes);
   }
   const TieTangent *ties = jacobian.Ties();
   const Vector on_freedoms = ties ? ties->Collect(forces) : Vector();
   forces.SetSubVector(jacobian.DisplacementDofs(), 0.0);
   if (ties)
   {
      ties->Ties().Scatter(on_freedoms, forces);
   }
   volumes.SetSubVector(jacobian.PressureDofs(), 0.0);
   Vector momentum(y, 0, split);
   Vector mass(y, split, volumes.Size());
   momentum.Add(scale, forces);
   mass.Add(-scale, volumes);
}

void MultiplierSystem::Close(Vector &v, Vector &y) const
{
   const int split = jacobian.Offsets()[1];
   const Vector displacement(v, 0, split);
   const Vector pressure(v, split, jacobian.Height() - split);
   Vector u(displacement);
   u.SetSubVector(jacobian.DisplacementDofs(), 0.0);
   if (const TieTangent *ties = jacobian.Ties())
   {
      ties->Move(ties->Ties().Gather(displacement), u);
   }
   Vector p(pressure);
   p.SetSubVector(jacobian.PressureDofs(), 0.0);
   for (const Block &block : blocks)
   {
      const ContactFactors &factors = block.factors;
      Vector gaps = block.Gaps(y);
      factors.gap_change->Mult(1.0, u, 0.0, gaps);
      gaps *= *factors.gap_weights;
      gaps.Add(-compliance, block.Gaps(v));
      Vector jumps = block.Jumps(y);
      factors.jump->Mult(1.0, p, 0.0, jumps);
      if (factors.jump_change)
      {
         factors.jump_change->Mult(1.0, u, 1.0, jumps);
      }
      jumps *= *factors.jump_weights;
      jumps *= jacobian.TimeStep();
      jumps.Add(-compliance, block.Jumps(v));
   }
}

void MultiplierSystem::Mult(const Vector &x, Vector &y) const
{
   unscaled = x;
   Scale(pressure_scale, 1.0 / pressure_scale, unscaled);
   const Vector bodies(unscaled, 0, jacobian.Height());
   Vector rows(y, 0, jacobian.Height());
   jacobian.Mult(bodies, rows);
   AddLoads(1.0, unscaled, y);
   Close(unscaled, y);
   Scale(pressure_scale, pressure_scale, y);
   Weigh(compliance, y);
}

Vector MultiplierSystem::RightSide(const Vector &b) const
{
   Vector side(Height());
   Vector bodies(side, 0, jacobian.Height());
   bodies = b;
   for (const Block &block : blocks)
   {
      const ContactFactors &factors = block.factors;
      Vector gaps = block.Gaps(side);
      gaps = *factors.gap_values;
      gaps *= *factors.gap_weights;
      gaps.Neg();
      Vector jumps = block.Jumps(side);
      jumps = *factors.jump_values;
      jumps *= *factors.jump_weights;
      jumps *= -jacobian.TimeStep();
   }
   Scale(pressure_scale, pressure_scale, side);
   Weigh(compliance, side);
   return side;
}

void MultiplierSystem::Precondition(const Operator &inverse, const Vector &rows,
                                    Vector &x) const
{
   unscaled = rows;
   Weigh(1.0 / compliance, unscaled);
   Scale(1.0 / pressure_scale, 1.0 / pressure_scale, unscaled);
   // Each multiplier takes what its row lacks, with the penalty for stiffness.
   x = unscaled;
   x.Neg();
   AddLoads(-1.0, x, unscaled);
   const Vector bodies(unscaled, 0, jacobian.Height());
   Vector solution(x, 0, jacobian.Height());
   inverse.Mult(bodies, solution);
   Scale(1.0 / pressure_scale, pressure_scale, x);
}

void MultiplierSystem::Unpack(const Vector &solution, Vector &x,
                              MultiplierChanges &changes) const
{
   unscaled = solution;
   Scale(pressure_scale, 1.0 / pressure_scale, unscaled);
   const Vector bodies(unscaled, 0, jacobian.Height());
   x = bodies;
   changes.Clear(jacobian.Contact().size());
   for (const Block &block : blocks)
   {
      const std::size_t term = &block.factors - jacobian.Contact().data();
      const Vector forces = block.Gaps(unscaled);
      const Vector volumes = block.Jumps(unscaled);
      changes.forces[term] = forces;
      changes.outflows[term] = volumes;
      changes.outflows[term] /= jacobian.TimeStep();
   }
}

} // namespace synovia
