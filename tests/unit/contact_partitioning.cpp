// ranks: 1
//
// Which ranks get the elements of bodies in contact.

#include "synovia/mesh/contact_partitioning.hpp"
#include "support/boxes.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <set>

using namespace mfem;
using namespace synovia;

namespace
{
/// Two plates one above the other, with n x n and m x m elements in a layer.
Mesh MakePlates(int n, int m)
{
   BoxOptions lower;
   lower.nx = lower.ny = n;
   lower.nz = 3;
   lower.size_z = 0.3;
   BoxOptions upper = lower;
   upper.nx = upper.ny = m;
   return MakeStackMesh(lower, upper);
}

/// Part of the faces of a boundary that a rank has.
double Share(Mesh &mesh, const std::vector<int> &part, int attribute, int rank)
{
   int all = 0;
   int own = 0;
   for (int i = 0; i < mesh.GetNBE(); i++)
   {
      if (mesh.GetBdrAttribute(i) == attribute)
      {
         int element = 0;
         int info = 0;
         mesh.GetBdrElementAdjacentElement(i, element, info);
         all++;
         own += part[element] == rank;
      }
   }
   REQUIRE(all > 0);
   return double(own) / all;
}

/// The attribute of the side of a plate that is at this height.
int SideAt(Mesh &mesh, double height, bool upper)
{
   for (int i = 0; i < mesh.GetNBE(); i++)
   {
      Vector center;
      mesh.GetBdrElementTransformation(i)->Transform(
         Geometries.GetCenter(mesh.GetBdrElementGeometry(i)), center);
      int element = 0;
      int info = 0;
      mesh.GetBdrElementAdjacentElement(i, element, info);
      if (std::abs(center[2] - height) < 1e-9 &&
          (mesh.GetAttribute(element) > 1) == upper)
      {
         return mesh.GetBdrAttribute(i);
      }
   }
   FAIL("no side is there");
   return 0;
}
} // namespace

TEST_CASE("Ranks share the contact and keep partners together")
{
   const int ranks = GENERATE(2, 3, 4, 9);
   CAPTURE(ranks);
   Mesh mesh = MakePlates(12, 10);
   const int below = SideAt(mesh, 0.3, false);
   const int above = SideAt(mesh, 0.3, true);
   const NameTable names{{"below", {below}}, {"above", {above}}};
   const std::vector<int> part =
      PartitionByContact(mesh, names, {{{"above"}, {"below"}}}, ranks);
   REQUIRE(static_cast<int>(part.size()) == mesh.GetNE());
   for (int rank = 0; rank < ranks; rank++)
   {
      CAPTURE(rank);
      const double mine = Share(mesh, part, below, rank);
      CHECK(mine > 0.6 / ranks);
      CHECK(mine < 1.4 / ranks);
      CHECK(std::abs(Share(mesh, part, above, rank) - mine) < 0.4 / ranks);
   }
}

TEST_CASE("Each rank gets elements, however few there are")
{
   Mesh mesh = MakePlates(1, 1);
   const int below = SideAt(mesh, 0.3, false);
   const int above = SideAt(mesh, 0.3, true);
   for (const int ranks : {1, 2, mesh.GetNE()})
   {
      CAPTURE(ranks);
      const std::vector<int> part =
         PartitionByContact(mesh, {{"below", {below}}, {"above", {above}}},
                            {{{"above"}, {"below", "unknown"}}}, ranks);
      const std::set<int> used(part.begin(), part.end());
      CHECK(static_cast<int>(used.size()) == ranks);
      CHECK(*used.begin() == 0);
      CHECK(*used.rbegin() == ranks - 1);
   }
}
