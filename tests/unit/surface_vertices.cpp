// ranks: 1 2 3 4
//
// The numbering of a surface's vertices, for faces that are dealt out to the
// ranks one by one: most vertices are shared, and ranks own some that none of
// their faces has.

#include "support/boxes.hpp"
#include "synovia/contact/contact_surface.hpp"
#include "synovia/general/reduce.hpp"
#include "synovia/mesh/boundary_marker.hpp"

#include <catch2/catch.hpp>

#include <cmath>

using namespace mfem;
using namespace synovia;

namespace
{
NamedMesh MakeBodies()
{
   BoxOptions box;
   box.nx = 4;
   box.ny = 3;
   box.nz = 2;
   Mesh serial = MakeStackMesh(box, box);
   std::vector<int> owners(serial.GetNE());
   for (int i = 0; i < serial.GetNE(); i++)
   {
      owners[i] = i % Mpi::WorldSize();
   }
   return DistributeStack(serial, MPI_COMM_WORLD, owners.data());
}
} // namespace

TEST_CASE("A surface numbers its vertices, and no others, over all ranks")
{
   const int order = GENERATE(1, 2, 3);
   CAPTURE(order);
   NamedMesh mesh = MakeBodies();
   BiphasicSpaces spaces(mesh.Get(), order);
   const ContactSurface surface(spaces, mesh.Boundary("lower_z1"));
   const SurfaceVertices &vertices = surface.Vertices();
   constexpr int all = 5 * 4;
   CHECK(vertices.GlobalSize() == all);
   CHECK(SumOverRanks(vertices.Size(), MPI_COMM_WORLD) == all);
   CHECK(vertices.Offsets()[1] - vertices.Offsets()[0] == vertices.Size());

   // A function is the same by true dofs, by own and by local vertices.
   const auto function = [](const Vector &x)
   { return 7.0 * x[0] - 3.0 * x[1]; };
   FunctionCoefficient coefficient(function);
   ParGridFunction field(&spaces.Multiplier());
   field.ProjectCoefficient(coefficient);
   Vector true_dofs;
   field.GetTrueDofs(true_dofs);
   const Vector own = vertices.FromTrueDofs(true_dofs);
   const Vector local = vertices.Share(own);
   REQUIRE(own.Size() == vertices.Size());
   REQUIRE(local.Size() == vertices.LocalSize());
   Vector touching(vertices.LocalSize());
   touching = 0.0;
   int corners = 0;
   for (const DeformedFace &face : surface.Faces())
   {
      const IntegrationRule &rule = *Geometries.GetVertices(face.GetGeometry());
      for (int i = 0; i < face.Vertices().Size(); i++)
      {
         const Point3 x = face.Reference(rule.IntPoint(i)).position;
         const Vector place(const_cast<real_t *>(x.data()), 3);
         CHECK(local[face.Vertices()[i]] ==
               Approx(function(place)).margin(1e-12));
         touching[face.Vertices()[i]] += 1.0;
         corners++;
      }
   }
   CHECK(SumOverRanks(corners, MPI_COMM_WORLD) == 4 * 4 * 3);

   // As many faces meet at a vertex whatever ranks they are on.
   const Vector meeting = vertices.SumShared(touching);
   CHECK(SumOverRanks(meeting.Sum(), MPI_COMM_WORLD) == 4 * 4 * 3);
   CHECK((meeting.Size() == 0 || meeting.Max() <= 4.0));
   CHECK((meeting.Size() == 0 || meeting.Min() >= 1.0));

   // Off the surface there is nothing.
   const Vector back = vertices.ToTrueDofs(own);
   Array<int> on_surface;
   spaces.Multiplier().GetEssentialTrueDofs(
      BoundaryMarker(mesh.Get(), surface.Boundary()), on_surface);
   REQUIRE(back.Size() == true_dofs.Size());
   for (int dof = 0; dof < back.Size(); dof++)
   {
      const bool on = on_surface.FindSorted(dof) >= 0;
      CHECK(back[dof] == (on ? true_dofs[dof] : 0.0));
   }
}
