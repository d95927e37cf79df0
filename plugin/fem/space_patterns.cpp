#include "synovia/fem/space_patterns.hpp"

namespace synovia
{

using namespace mfem;

std::shared_ptr<const NodePattern>
SpacePatterns::Between(const ParFiniteElementSpace &rows,
                       const ParFiniteElementSpace &columns)
{
   const bool same_nodes = spaces.Order() == 1;
   std::shared_ptr<const NodePattern> &pattern =
      patterns[same_nodes ? Spaces() : Spaces(&rows, &columns)];
   if (!pattern)
   {
      pattern = std::make_shared<const NodePattern>(rows, columns);
   }
   return pattern;
}

} // namespace synovia
