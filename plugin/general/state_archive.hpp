#pragma once

#include "mfem.hpp"

#include <string>

namespace synovia
{

/// Takes the state of an object to a checkpoint or brings it back from one.
///
/// An object lists its state once, in a member Archive(StateArchive &), and the
/// same list serves both directions. Names tell the entries apart; all ranks
/// list the same ones in the same order.
class StateArchive
{
public:
   virtual ~StateArchive() = default;

   /// Whether values come from the archive, or go into it.
   virtual bool Reads() const = 0;

   /// A number that is the same on all ranks.
   virtual void Number(const std::string &name, mfem::real_t &value) = 0;

   /// A vector of the true dofs of @a space, which stays the size it has.
   virtual void Field(const std::string &name,
                      mfem::ParFiniteElementSpace &space,
                      mfem::Vector &true_dofs) = 0;

   void Count(const std::string &name, int &value)
   {
      mfem::real_t number = value;
      Number(name, number);
      value = static_cast<int>(number);
   }

   void Flag(const std::string &name, bool &value)
   {
      mfem::real_t number = value ? 1.0 : 0.0;
      Number(name, number);
      value = number != 0.0;
   }
};

} // namespace synovia
