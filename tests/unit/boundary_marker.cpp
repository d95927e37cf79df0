// ranks: 1 2 3
//
// Attributes that a mesh doesn't have are errors wherever programs give them.

#include "support/boxes.hpp"
#include "synovia/synovia.hpp"

#include "synovia/mesh/boundary_marker.hpp"

#include <catch2/catch.hpp>

using namespace mfem;
using namespace synovia;

TEST_CASE("A marker has ones where the attributes are")
{
   BoxOptions box;
   const NamedMesh mesh = MakeStack(box, box);
   const Array<int> top = mesh.Boundary("upper_z1");
   REQUIRE(top.Size() == 1);
   const Array<int> marker = BoundaryMarker(mesh.Get(), top);
   CHECK(marker.Size() == mesh.Get().bdr_attributes.Max());
   CHECK(marker.Sum() == 1);
   CHECK(marker[top[0] - 1] == 1);
   CHECK(BoundaryMarker(mesh.Get(), Array<int>()).Sum() == 0);
}

TEST_CASE("Unknown attributes are named, with those there are")
{
   BoxOptions box;
   NamedMesh mesh = MakeStack(box, box);
   BiphasicSpaces spaces(mesh.Get(), 1);
   std::string known;
   for (const int attribute : mesh.Get().bdr_attributes)
   {
      known += (known.empty() ? "" : ", ") + std::to_string(attribute);
   }
   for (const int unknown : {-1, 0, 99})
   {
      const std::string message = "no boundary has the attribute " +
                                  std::to_string(unknown) +
                                  "; there are: " + known;
      Array<int> boundary(mesh.Boundary("upper_z1"));
      boundary.Append(unknown);
      CHECK_THROWS_WITH(BoundaryMarker(mesh.Get(), boundary), message);
      CHECK_THROWS_WITH(SpringFoundation(spaces, boundary, 1.0, Vector()),
                        message);
      CHECK_THROWS_WITH(ContactSurface(spaces, boundary), message);
      const DrivenSurface driven{
         "driven", boundary, {{0.0, 0.0, 1.0}}, LoadCurve(1.0)};
      CHECK_THROWS_WITH(RigidSurfaces(spaces, {driven}, Array<int>()), message);
   }
}
