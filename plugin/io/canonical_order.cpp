#include "synovia/io/canonical_order.hpp"
#include "synovia/general/exchange.hpp"
#include "synovia/general/root_rank.hpp"

#include <algorithm>
#include <cmath>
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

/// The rank whose part has what goes by a serial element.
int OwnerOf(double element, long long elements, int ranks)
{
   return static_cast<int>(static_cast<long long>(element) * ranks / elements);
}
} // namespace

CanonicalOrder::CanonicalOrder(const ParFiniteElementSpace &space,
                               const std::vector<int> &serial_elements)
   : comm(space.GetComm())
{
   const std::vector<double> keys = Keys(space, serial_elements);
   int ranks = 1;
   MPI_Comm_size(comm, &ranks);
   const long long elements = space.GetParMesh()->GetGlobalNE();
   sent.resize(ranks);
   std::vector<std::vector<double>> outgoing(ranks);
   for (std::size_t i = 0; i < keys.size(); i++)
   {
      const double element = std::floor(keys[i] / (stride * space.GetVDim()));
      const int owner = OwnerOf(element, elements, ranks);
      sent[owner].push_back(static_cast<int>(i));
      outgoing[owner].push_back(keys[i]);
   }
   std::vector<double> of_part;
   for (const std::vector<double> &some : Exchange(std::move(outgoing), comm))
   {
      received.push_back(some.size());
      of_part.insert(of_part.end(), some.begin(), some.end());
   }
   std::vector<std::size_t> sorted(of_part.size());
   std::iota(sorted.begin(), sorted.end(), 0);
   std::sort(sorted.begin(), sorted.end(),
             [&](std::size_t a, std::size_t b)
             { return of_part[a] < of_part[b]; });
   place.resize(sorted.size());
   for (std::size_t i = 0; i < sorted.size(); i++)
   {
      place[sorted[i]] = i;
   }
   long long before = 0;
   const long long mine = static_cast<long long>(place.size());
   MPI_Exscan(&mine, &before, 1, MPI_LONG_LONG, MPI_SUM, comm);
   begin = IsRoot(comm) ? 0 : before;
}

std::vector<double> CanonicalOrder::ToOrder(const Vector &true_dofs) const
{
   const double *const values = true_dofs.HostRead();
   std::vector<std::vector<double>> outgoing(sent.size());
   for (std::size_t r = 0; r < sent.size(); r++)
   {
      for (const int dof : sent[r])
      {
         outgoing[r].push_back(values[dof]);
      }
   }
   std::vector<double> part(place.size());
   std::size_t i = 0;
   for (const std::vector<double> &some : Exchange(std::move(outgoing), comm))
   {
      for (const double value : some)
      {
         part[place[i++]] = value;
      }
   }
   return part;
}

void CanonicalOrder::FromOrder(const std::vector<double> &part,
                               Vector &true_dofs) const
{
   MFEM_VERIFY(part.size() == Size(), "a part of another order");
   std::vector<std::vector<double>> outgoing(received.size());
   std::size_t i = 0;
   for (std::size_t r = 0; r < received.size(); r++)
   {
      for (std::size_t k = 0; k < received[r]; k++)
      {
         outgoing[r].push_back(part[place[i++]]);
      }
   }
   const auto incoming = Exchange(std::move(outgoing), comm);
   double *const values = true_dofs.HostWrite();
   for (std::size_t r = 0; r < sent.size(); r++)
   {
      for (std::size_t k = 0; k < sent[r].size(); k++)
      {
         values[sent[r][k]] = incoming[r][k];
      }
   }
}

} // namespace synovia
