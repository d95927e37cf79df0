#include "synovia/linalg/reduced_contact.hpp"

namespace synovia
{

using namespace mfem;

ReducedContact::ReducedContact(const ContactTerms &original_,
                               const RigidSurfaces *rigid_)
   : original(original_), rigid(rigid_), reduced(original_)
{
}

const HypreParMatrix *
ReducedContact::ReduceColumns(const HypreParMatrix *matrix)
{
   if (!matrix)
   {
      return nullptr;
   }
   matrices.push_back(rigid->Reduce(*matrix));
   return matrices.back().get();
}

const HypreParMatrix *ReducedContact::ReduceBoth(const HypreParMatrix *matrix)
{
   if (!matrix)
   {
      return nullptr;
   }
   matrices.push_back(rigid->ReduceBoth(*matrix));
   return matrices.back().get();
}

void ReducedContact::Update()
{
   if (!rigid)
   {
      return;
   }
   matrices.clear();
   reduced = original;
   for (ContactFactors &factors : reduced)
   {
      const bool one_gap = factors.gap_change == factors.gap;
      factors.gap = ReduceColumns(factors.gap);
      factors.gap_change =
         one_gap ? factors.gap : ReduceColumns(factors.gap_change);
      factors.jump_change = ReduceColumns(factors.jump_change);
      factors.outflow_change = ReduceColumns(factors.outflow_change);
      if (factors.force_by_pressure)
      {
         const std::unique_ptr<HypreParMatrix> columns(
            factors.force_by_pressure->Transpose());
         matrices.emplace_back(rigid->Reduce(*columns)->Transpose());
         factors.force_by_pressure = matrices.back().get();
      }
      factors.force_change = ReduceBoth(factors.force_change);
      factors.soft_force_change = ReduceBoth(factors.soft_force_change);
   }
}

} // namespace synovia
