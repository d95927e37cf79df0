#pragma once

#include "synovia/general/state_archive.hpp"

#include <map>
#include <string>

namespace synovia
{

/// A state in memory, for another object on the same ranks and mesh: what is
/// written first is read then, as far as the other one lists it too.
class StateSnapshot : public StateArchive
{
public:
   /// From now on values come from the archive; those that it lacks stay.
   void Rewind() { reads = true; }

   bool Reads() const override { return reads; }
   void Number(const std::string &name, mfem::real_t &value) override;
   void Field(const std::string &name, mfem::ParFiniteElementSpace &space,
              mfem::Vector &true_dofs) override;

private:
   bool reads = false;
   std::map<std::string, mfem::real_t> numbers;
   std::map<std::string, mfem::Vector> fields;
};

} // namespace synovia
