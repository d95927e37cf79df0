// ranks: 1 2 3
//
// Nodes of bodies that rigid ones carry, from one pose to another.

#include "synovia/physics/carried_nodes.hpp"
#include "support/boxes.hpp"
#include "synovia/fem/node_positions.hpp"
#include "synovia/fem/rigid_motions.hpp"
#include "synovia/general/reduce.hpp"
#include "synovia/synovia.hpp"

#include <catch2/catch.hpp>

using namespace mfem;
using namespace synovia;

namespace
{
/// Two blocks, of which the rigid body "bone" carries the upper one.
struct Blocks
{
   explicit Blocks(Deformation deformation = Deformation::finite,
                   const Array<int> &other = {})
      : mesh(MakeStack(Block(), Block())), spaces(mesh.Get(), 1),
        bodies(FindBodies(mesh, spaces)), motions(bodies, spaces),
        positions(NodePositions(spaces.Displacement()))
   {
      RigidBodyOptions options;
      options.reference = reference;
      rigid_bodies.push_back({"bone", mesh.Boundary("upper_z1"), options});
      if (!other.IsEmpty())
      {
         rigid_bodies.push_back({"other", other, options});
      }
      ties = std::make_unique<RigidTies>(spaces, rigid_bodies, Array<int>(),
                                         deformation);
      carried =
         std::make_unique<CarriedNodes>(bodies, spaces, rigid_bodies, *ties);
   }

   static BoxOptions Block()
   {
      BoxOptions box;
      box.nx = box.ny = 3;
      box.nz = 2;
      return box;
   }

   Point3 ArmOf(int dof) const
   {
      return Sum({{positions[dof], positions[dof + 1], positions[dof + 2]}},
                 -1.0, reference);
   }

   /// Displacements of all nodes in a pose.
   Vector In(const RigidPose &pose) const
   {
      const RigidFrame frame(pose, Deformation::finite);
      Vector u(positions.Size());
      for (int dof = 0; dof < u.Size(); dof += 3)
      {
         const Point3 displacement = frame.Displacement(ArmOf(dof));
         std::copy(displacement.begin(), displacement.end(), u.GetData() + dof);
      }
      return u;
   }

   bool IsCarried(int dof) const
   {
      return bodies[motions.BodyOf(dof)].name == "upper" &&
             ties->Dofs().FindSorted(dof) < 0;
   }

   NamedMesh mesh;
   BiphasicSpaces spaces;
   std::vector<Body> bodies;
   RigidMotions motions;
   Vector positions;
   const Point3 reference{{0.2, -0.4, 2.5}};
   std::vector<RigidBody> rigid_bodies;
   std::unique_ptr<RigidTies> ties;
   std::unique_ptr<CarriedNodes> carried;
};

const RigidPose begin{{0.3, -0.2, 0.1, 0.4, -0.3, 0.2}};
const RigidPose end{{-0.1, 0.5, 0.2, -0.5, 0.6, 0.9}};
} // namespace

TEST_CASE("Nodes are carried rigidly, and others stay")
{
   const Blocks blocks;
   REQUIRE(blocks.carried->Any());
   // As deformed in its own frame as before: stretched along each arm.
   constexpr real_t stretch = 0.05;
   const RigidFrame first(begin, Deformation::finite);
   const RigidFrame second(end, Deformation::finite);
   Vector u = blocks.In(begin);
   for (int dof = 0; dof < u.Size(); dof += 3)
   {
      const Point3 extra = first.Turned(blocks.ArmOf(dof));
      for (int d = 0; d < 3; d++)
      {
         u[dof + d] += stretch * extra[d];
      }
   }
   const Vector before(u);
   blocks.carried->Carry({begin}, {end}, u);
   const Vector there = blocks.In(end);
   int carried = 0;
   for (int dof = 0; dof < u.Size(); dof += 3)
   {
      const Point3 extra = second.Turned(blocks.ArmOf(dof));
      const bool moves = blocks.IsCarried(dof);
      carried += moves ? 1 : 0;
      for (int d = 0; d < 3; d++)
      {
         const real_t expected =
            moves ? there[dof + d] + stretch * extra[d] : before[dof + d];
         CHECK(u[dof + d] == Approx(expected).margin(1e-13));
      }
   }
   CHECK(SumOverRanks(carried, MPI_COMM_WORLD) == 32);

   Vector copy(before);
   blocks.carried->Copy(u, copy);
   copy -= u;
   CHECK((copy.Size() == 0 || copy.Normlinf() == 0.0));
}

TEST_CASE("The turn between two poses is an angle")
{
   const Blocks blocks;
   const RigidPose quarter{{1.0, 2.0, 3.0, 0.0, 0.5 * M_PI, 0.0}};
   const RigidPose more{{0.0, 0.0, 0.0, 0.0, 0.5 * M_PI + 0.3, 0.0}};
   CHECK(blocks.carried->Turn({quarter}, {more}) == Approx(0.3));
   CHECK(blocks.carried->Turn({more}, {more}) == Approx(0.0).margin(1e-7));
}

TEST_CASE("A body between two rigid ones is carried by neither")
{
   CHECK_FALSE(Blocks(Deformation::finite, Blocks().mesh.Boundary("upper_z0"))
                  .carried->Any());
   const Blocks both(Deformation::finite, Blocks().mesh.Boundary("lower_z0"));
   CHECK(both.carried->Any());
}

TEST_CASE("In infinitesimal deformation nothing is carried")
{
   CHECK_FALSE(Blocks(Deformation::infinitesimal).carried->Any());
}
