#pragma once

#include "synovia/fem/biphasic_spaces.hpp"
#include "synovia/fem/node_pattern.hpp"

#include <map>
#include <memory>
#include <utility>

namespace synovia
{

/// Patterns of matrices between displacement and pressure, each found when it
/// is asked for first and then shared. In order 1 all are one.
class SpacePatterns
{
public:
   /// Borrows @a spaces.
   explicit SpacePatterns(BiphasicSpaces &spaces_) : spaces(spaces_) {}

   /// @a rows and @a columns are displacements or pressures of the spaces.
   /// Collective.
   std::shared_ptr<const NodePattern>
   Between(const mfem::ParFiniteElementSpace &rows,
           const mfem::ParFiniteElementSpace &columns);

private:
   /// Of rows and of columns.
   using Spaces = std::pair<const mfem::ParFiniteElementSpace *,
                            const mfem::ParFiniteElementSpace *>;

   BiphasicSpaces &spaces;
   std::map<Spaces, std::shared_ptr<const NodePattern>> patterns;
};

} // namespace synovia
