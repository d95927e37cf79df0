#include "support/gathered_order.hpp"
#include "synovia/general/exchange.hpp"
#include "synovia/io/canonical_order.hpp"

namespace synovia
{

using namespace mfem;

std::vector<double> GatherInOrder(const NamedMesh &mesh,
                                  const ParFiniteElementSpace &space,
                                  const Vector &true_dofs)
{
   int ranks = 1;
   MPI_Comm_size(space.GetComm(), &ranks);
   std::vector<std::vector<double>> outgoing(ranks);
   outgoing.front() =
      CanonicalOrder(space, mesh.SerialElements()).ToOrder(true_dofs);
   std::vector<double> all;
   for (const auto &part : Exchange(std::move(outgoing), space.GetComm()))
   {
      all.insert(all.end(), part.begin(), part.end());
   }
   return all;
}

} // namespace synovia
