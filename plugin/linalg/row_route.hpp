#pragma once

#include "mfem.hpp"

#include <vector>

namespace synovia
{

/// Sends entries of distributed vectors to the ranks that own their rows. The
/// route is found once, for all vectors whose entries are at the same places.
class RowRoute
{
public:
   /// @a rows are the global rows, from 0, of the entries on this rank, and
   /// @a first_row the first of those that it owns. Each row must be on one
   /// rank. Collective.
   RowRoute(const std::vector<HYPRE_BigInt> &rows, HYPRE_BigInt first_row,
            MPI_Comm comm);

   /// Sends @a entries, in the order of the rows given, into the vector of the
   /// rows owned, which has its size. Collective.
   void Bring(const mfem::real_t *entries, mfem::Vector &owned);

private:
   /// How many entries go to each rank, or come from there, and where these
   /// begin.
   struct Parcels
   {
      std::vector<int> counts;
      std::vector<int> begins;
      mfem::Vector entries;

      void Append(std::size_t count);
   };

   MPI_Comm comm;
   Parcels outgoing;
   Parcels incoming;
   std::vector<int> places_before;
   std::vector<int> places_owned;
};

} // namespace synovia
