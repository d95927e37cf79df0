#include "synovia/io/canonical_order.hpp"

#include <algorithm>
#include <limits>
#include <numeric>

namespace synovia
{

using namespace mfem;

namespace
{
// More than any element has dofs: of order 10 a hexahedron has 1331. Keys fit
// exactly into a double for 10^11 elements.
constexpr double stride = 4096.0;

/// Keys of this rank's true dofs that tell their order.
std::vector<double> Keys(const ParFiniteElementSpace &space,
                         const std::vector<int> &serial_elements)
{
   Array<double> keys(space.GetVSize());
   keys = std::numeric_limits<double>::max();
   Array<int> dofs;
   for (int i = 0; i < space.GetNE(); i++)
   {
      space.GetElementDofs(i, dofs);
      for (int j = 0; j < dofs.Size(); j++)
      {
         MFEM_VERIFY(dofs[j] >= 0, "dofs with signs have no canonical order");
         for (int d = 0; d < space.GetVDim(); d++)
         {
            double &key = keys[space.DofToVDof(dofs[j], d)];
            key = std::min(
               key, (serial_elements[i] * stride + j) * space.GetVDim() + d);
         }
      }
   }
   space.GroupComm().Reduce<double>(keys, GroupCommunicator::Min<double>);
   std::vector<double> of_true_dofs(space.GetTrueVSize());
   for (int i = 0; i < keys.Size(); i++)
   {
      const int true_dof = space.GetLocalTDofNumber(i);
      if (true_dof >= 0)
      {
         of_true_dofs[true_dof] = keys[i];
      }
   }
   return of_true_dofs;
}
} // namespace

CanonicalOrder::CanonicalOrder(const ParFiniteElementSpace &space,
                               const std::vector<int> &serial_elements)
   : comm(space.GetComm())
{
   const std::vector<double> mine = Keys(space, serial_elements);
   int rank = 0;
   int ranks = 1;
   MPI_Comm_rank(comm, &rank);
   MPI_Comm_size(comm, &ranks);
   const int count = static_cast<int>(mine.size());
   counts.resize(rank == 0 ? ranks : 0);
   MPI_Gather(&count, 1, MPI_INT, counts.data(), 1, MPI_INT, 0, comm);
   begins.resize(counts.size());
   for (std::size_t r = 1; r < counts.size(); r++)
   {
      begins[r] = begins[r - 1] + counts[r - 1];
   }
   std::vector<double> keys(counts.empty() ? 0 : begins.back() + counts.back());
   MPI_Gatherv(mine.data(), count, MPI_DOUBLE, keys.data(), counts.data(),
               begins.data(), MPI_DOUBLE, 0, comm);
   std::vector<int> sorted(keys.size());
   std::iota(sorted.begin(), sorted.end(), 0);
   std::sort(sorted.begin(), sorted.end(),
             [&](int a, int b) { return keys[a] < keys[b]; });
   place.resize(keys.size());
   for (std::size_t i = 0; i < sorted.size(); i++)
   {
      place[sorted[i]] = static_cast<int>(i);
   }
}

std::vector<double> CanonicalOrder::Gather(const Vector &true_dofs) const
{
   std::vector<double> by_rank(place.size());
   MPI_Gatherv(true_dofs.HostRead(), true_dofs.Size(), MPI_DOUBLE,
               by_rank.data(), counts.data(), begins.data(), MPI_DOUBLE, 0,
               comm);
   std::vector<double> values(place.size());
   for (std::size_t i = 0; i < place.size(); i++)
   {
      values[place[i]] = by_rank[i];
   }
   return values;
}

void CanonicalOrder::Scatter(const std::vector<double> &values,
                             Vector &true_dofs) const
{
   std::vector<double> by_rank(place.size());
   for (std::size_t i = 0; i < place.size(); i++)
   {
      by_rank[i] = values[place[i]];
   }
   MPI_Scatterv(by_rank.data(), counts.data(), begins.data(), MPI_DOUBLE,
                true_dofs.HostWrite(), true_dofs.Size(), MPI_DOUBLE, 0, comm);
}

} // namespace synovia
