// ranks: 1 2 3
//
// The order of unknowns in files: each rank has a part of it, and it does not
// depend on how many there are.

#include "synovia/io/canonical_order.hpp"
#include "support/boxes.hpp"
#include "support/gathered_order.hpp"

#include <catch2/catch.hpp>

#include <algorithm>

using namespace mfem;
using namespace synovia;

namespace
{
Mesh MakeSerialMesh()
{
   BoxOptions box;
   box.nx = 4;
   box.ny = 3;
   box.nz = 5;
   return MakeBoxMesh(box);
}

/// A box with a vector for each node of order 2.
class Nodes
{
public:
   explicit Nodes(MPI_Comm comm)
      : mesh(DistributeMesh(serial, {{"body", {1}}}, {}, comm)), elements(2, 3),
        space(&mesh.Get(), &elements, 3, Ordering::byVDIM)
   {
   }
   const ParFiniteElementSpace &Space() const { return space; }
   const NamedMesh &GetMesh() const { return mesh; }

   /// Of each node where it is.
   Vector Places()
   {
      VectorFunctionCoefficient place(3, [](const Vector &x, Vector &values)
                                      { values = x; });
      ParGridFunction at(&space);
      at.ProjectCoefficient(place);
      Vector true_dofs;
      at.GetTrueDofs(true_dofs);
      return true_dofs;
   }

private:
   Mesh serial = MakeSerialMesh();
   NamedMesh mesh;
   H1_FECollection elements;
   ParFiniteElementSpace space;
};
} // namespace

TEST_CASE("Every rank has a part of the order, and none much more than others")
{
   Nodes nodes(MPI_COMM_WORLD);
   const CanonicalOrder order(nodes.Space(), nodes.GetMesh().SerialElements());
   const long long size = static_cast<long long>(order.Size());
   const long long all = nodes.Space().GlobalTrueVSize();
   long long before = 0;
   MPI_Exscan(&size, &before, 1, MPI_LONG_LONG, MPI_SUM, MPI_COMM_WORLD);
   long long sum = 0;
   MPI_Allreduce(&size, &sum, 1, MPI_LONG_LONG, MPI_SUM, MPI_COMM_WORLD);
   CHECK(sum == all);
   CHECK(static_cast<long long>(order.Begin()) ==
         (Mpi::WorldRank() == 0 ? 0 : before));
   CHECK(size > 0);
   CHECK(size * Mpi::WorldSize() < 2 * all);
}

TEST_CASE("The order of unknowns does not depend on the number of ranks")
{
   Nodes together(MPI_COMM_WORLD);
   Nodes alone(MPI_COMM_SELF);
   const std::vector<double> gathered =
      GatherInOrder(together.GetMesh(), together.Space(), together.Places());
   const std::vector<double> expected =
      GatherInOrder(alone.GetMesh(), alone.Space(), alone.Places());
   CHECK(expected.size() == std::size_t(3 * 9 * 7 * 11));
   if (Mpi::Root())
   {
      CHECK(gathered == expected);
   }
   else
   {
      CHECK(gathered.empty());
   }
}

TEST_CASE("Values come back from the order as they went there")
{
   Nodes nodes(MPI_COMM_WORLD);
   const CanonicalOrder order(nodes.Space(), nodes.GetMesh().SerialElements());
   const Vector places = nodes.Places();
   const std::vector<double> part = order.ToOrder(places);
   CHECK(*std::max_element(part.begin(), part.end()) > 0.1);
   Vector back(places.Size());
   back = -1.0;
   order.FromOrder(part, back);
   CHECK(std::equal(back.begin(), back.end(), places.begin()));
}
