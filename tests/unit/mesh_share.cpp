// ranks: 1 2 3 4 16
// A mesh that rank 0 alone holds, in the shares of the ranks.

#include "synovia/mesh/mesh_share.hpp"
#include "synovia/mesh/stack_bodies.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>

using namespace mfem;
using namespace synovia;

namespace
{
int Rank()
{
   int rank = 0;
   MPI_Comm_rank(MPI_COMM_WORLD, &rank);
   return rank;
}

/// Bodies of these types, with elements of this order.
Mesh Bodies(const std::vector<Element::Type> &types, int order)
{
   std::vector<Mesh> bodies;
   for (const Element::Type type : types)
   {
      bodies.push_back(Mesh::MakeCartesian3D(2, 1, 1, type));
   }
   std::vector<const Mesh *> list;
   for (const Mesh &body : bodies)
   {
      list.push_back(&body);
   }
   Mesh stack = StackBodies(list).mesh;
   // With a third digit in each place, so that rounding would show.
   stack.SetCurvature(order);
   stack.Transform(
      [](const Vector &from, Vector &to)
      {
         to = from;
         to[2] += 0.1 * std::sin(from[0] + 0.3) * from[1] / 3.0;
      });
   stack.Finalize(true, false);
   return stack;
}

/// Without pyramids, which can't be split.
Mesh Splittable()
{
   return Bodies({Element::HEXAHEDRON, Element::TETRAHEDRON, Element::WEDGE},
                 2);
}

/// Elements of all shapes.
Mesh AllShapes(int order)
{
   return Bodies({Element::HEXAHEDRON, Element::PYRAMID, Element::TETRAHEDRON,
                  Element::WEDGE},
                 order);
}

MeshShare Share(const Mesh &whole, MPI_Comm comm,
                std::vector<int> partitioning = {})
{
   int rank = 0;
   MPI_Comm_rank(comm, &rank);
   Mesh serial = rank == 0 ? Mesh(whole) : Mesh();
   return ScatterMesh(serial, {}, {}, comm, partitioning);
}

/// The positions of a point inside of an element and of its vertices, in order.
std::vector<real_t> Places(Mesh &mesh, int element)
{
   std::vector<real_t> places;
   Vector x;
   IsoparametricTransformation map;
   mesh.GetElementTransformation(element, &map);
   const Geometry::Type geometry = mesh.GetElementGeometry(element);
   map.Transform(Geometries.GetCenter(geometry), x);
   places.insert(places.end(), x.begin(), x.end());
   const IntegrationRule &vertices = *Geometries.GetVertices(geometry);
   for (int i = 0; i < vertices.GetNPoints(); i++)
   {
      map.Transform(vertices[i], x);
      places.insert(places.end(), x.begin(), x.end());
   }
   return places;
}

real_t AreaOf(Mesh &mesh, int attribute)
{
   real_t area = 0.0;
   for (int i = 0; i < mesh.GetNBE(); i++)
   {
      if (mesh.GetBdrAttribute(i) == attribute)
      {
         ElementTransformation &map = *mesh.GetBdrElementTransformation(i);
         const IntegrationRule &rule =
            IntRules.Get(mesh.GetBdrElementGeometry(i), 4);
         for (int q = 0; q < rule.GetNPoints(); q++)
         {
            map.SetIntPoint(&rule[q]);
            area += rule[q].weight * map.Weight();
         }
      }
   }
   return area;
}

/// That the elements of all shares are those of a mesh, each once.
void CompareElements(MeshShare &share, Mesh &whole)
{
   std::vector<int> found(whole.GetNE(), 0);
   REQUIRE(static_cast<int>(share.serial_elements.size()) ==
           share.mesh->GetNE());
   for (int i = 0; i < share.mesh->GetNE(); i++)
   {
      const int number = share.serial_elements[i];
      REQUIRE(number >= 0);
      REQUIRE(number < whole.GetNE());
      found[number]++;
      CHECK(share.mesh->GetAttribute(i) == whole.GetAttribute(number));
      const std::vector<real_t> here = Places(*share.mesh, i);
      const std::vector<real_t> there = Places(whole, number);
      REQUIRE(here.size() == there.size());
      for (std::size_t k = 0; k < here.size(); k++)
      {
         CHECK(std::abs(here[k] - there[k]) <= 1e-15);
      }
   }
   MPI_Allreduce(MPI_IN_PLACE, found.data(), whole.GetNE(), MPI_INT, MPI_SUM,
                 MPI_COMM_WORLD);
   CHECK(std::all_of(found.begin(), found.end(),
                     [](int times) { return times == 1; }));
}

/// That all boundaries have their attributes and are as large.
void CompareBoundaries(MeshShare &share, Mesh &whole)
{
   CHECK(share.mesh->attributes.Size() == whole.attributes.Size());
   REQUIRE(share.mesh->bdr_attributes.Size() == whole.bdr_attributes.Size());
   for (const int attribute : whole.bdr_attributes)
   {
      real_t area = AreaOf(*share.mesh, attribute);
      MPI_Allreduce(MPI_IN_PLACE, &area, 1, MPI_DOUBLE, MPI_SUM,
                    MPI_COMM_WORLD);
      CHECK(area == Approx(AreaOf(whole, attribute)).epsilon(1e-12));
   }
}
} // namespace

TEST_CASE("mesh share: elements and boundaries are those of the whole mesh")
{
   const int order = GENERATE(1, 2);
   Mesh whole = AllShapes(order);
   MeshShare share = Share(whole, MPI_COMM_WORLD);
   REQUIRE(share.mesh->GetNE() > 0);
   CompareElements(share, whole);
   CompareBoundaries(share, whole);
}

TEST_CASE("mesh share: ranks may have no elements that are straight")
{
   const auto type = GENERATE(Element::HEXAHEDRON, Element::TETRAHEDRON);
   Mesh whole = Mesh::MakeCartesian3D(3, 2, 4, type);
   // Each second rank has some.
   const int filled = (Mpi::WorldSize() + 1) / 2;
   std::vector<int> owners(whole.GetNE());
   for (int i = 0; i < whole.GetNE(); i++)
   {
      owners[i] = 2 * (i % filled);
   }
   MeshShare share = Share(whole, MPI_COMM_WORLD, owners);
   CHECK((share.mesh->GetNE() > 0) == (Rank() % 2 == 0));
   CompareElements(share, whole);
   CompareBoundaries(share, whole);
}

TEST_CASE("mesh share: parts of elements have the same numbers on any number "
          "of ranks")
{
   const int times = GENERATE(0, 1, 2);
   const Mesh whole = Splittable();
   MeshShare alone = Share(whole, MPI_COMM_SELF);
   const std::vector<int> origins = RefineUniformly(alone, times);
   // In order of their numbers.
   Mesh &all = *alone.mesh;
   std::vector<int> element(all.GetNE(), -1);
   for (int i = 0; i < all.GetNE(); i++)
   {
      const int number = alone.serial_elements[i];
      REQUIRE(number >= 0);
      REQUIRE(number < all.GetNE());
      element[number] = i;
   }

   MeshShare share = Share(whole, MPI_COMM_WORLD);
   const std::vector<int> former = share.serial_elements;
   const std::vector<int> own_origins = RefineUniformly(share, times);
   REQUIRE(share.mesh->GetGlobalNE() == all.GetNE());
   REQUIRE(share.mesh->GetNE() > 0);
   for (int i = 0; i < share.mesh->GetNE(); i++)
   {
      const int same = element[share.serial_elements[i]];
      REQUIRE(same >= 0);
      CHECK(former[own_origins[i]] == origins[same]);
      const std::vector<real_t> here = Places(*share.mesh, i);
      const std::vector<real_t> there = Places(all, same);
      REQUIRE(here.size() == there.size());
      for (std::size_t k = 0; k < here.size(); k++)
      {
         CHECK(std::abs(here[k] - there[k]) <= 1e-14);
      }
   }
}

TEST_CASE("mesh share: pyramids can't be split")
{
   MeshShare share = Share(AllShapes(1), MPI_COMM_WORLD);
   CHECK_NOTHROW(RefineUniformly(share, 0));
   CHECK_THROWS_WITH(RefineUniformly(share, 1),
                     "pyramids can't be split; refine the mesh where it is "
                     "made");
}

TEST_CASE("mesh share: values of elements go where these go")
{
   const Mesh whole = AllShapes(1);
   Mesh serial = Rank() == 0 ? Mesh(whole) : Mesh();
   std::vector<int> partitioning;
   const MeshShare share =
      ScatterMesh(serial, {}, {}, MPI_COMM_WORLD, partitioning);
   std::vector<double> squares;
   for (int i = 0; i < serial.GetNE(); i++)
   {
      squares.push_back(0.5 * i * i);
   }
   const std::vector<double> own =
      ScatterByElement(squares, partitioning, MPI_COMM_WORLD);
   REQUIRE(own.size() == share.serial_elements.size());
   REQUIRE(!own.empty());
   for (std::size_t i = 0; i < own.size(); i++)
   {
      const int number = share.serial_elements[i];
      CHECK(own[i] == 0.5 * number * number);
   }
}
