#include "synovia/io/state_snapshot.hpp"

namespace synovia
{

using namespace mfem;

void StateSnapshot::Number(const std::string &name, real_t &value)
{
   if (!reads)
   {
      numbers[name] = value;
   }
   else if (const auto found = numbers.find(name); found != numbers.end())
   {
      value = found->second;
   }
}

void StateSnapshot::Field(const std::string &name, ParFiniteElementSpace &,
                          Vector &true_dofs)
{
   if (!reads)
   {
      fields[name] = true_dofs;
   }
   else if (const auto found = fields.find(name); found != fields.end())
   {
      MFEM_VERIFY(found->second.Size() == true_dofs.Size(),
                  "a snapshot is for objects with the same dofs");
      true_dofs = found->second;
   }
}

} // namespace synovia
