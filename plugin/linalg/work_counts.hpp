#pragma once

namespace synovia
{

/// Numbers of expensive operations.
struct WorkCounts
{
   /// Assemblies of the bodies' matrices.
   int assemblies = 0;
   /// Searches for contact after which the gap operators were assembled anew.
   int searches = 0;
   /// Multigrid hierarchies set up.
   int setups = 0;
   /// Factorizations, of the whole matrix or of the part that contact touches.
   int factorizations = 0;
   /// Solves for columns of low-rank updates (Woodbury).
   int columns = 0;

   WorkCounts &operator+=(const WorkCounts &other) { return Add(other, 1); }
   WorkCounts &operator-=(const WorkCounts &other) { return Add(other, -1); }

private:
   WorkCounts &Add(const WorkCounts &other, int times)
   {
      assemblies += times * other.assemblies;
      searches += times * other.searches;
      setups += times * other.setups;
      factorizations += times * other.factorizations;
      columns += times * other.columns;
      return *this;
   }
};

} // namespace synovia
