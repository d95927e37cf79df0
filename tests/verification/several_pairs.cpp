// ranks: 1 2 3
//
// Surfaces in more than one contact pair, and bodies that only contact holds
// along the load: three columns on top of each other are one of triple height,
// and two blocks on one plate bear the same, although the plate's top is
// destination to one of them and source to the other.

#include "support/boxes.hpp"
#include "synovia/general/reduce.hpp"
#include "synovia/synovia.hpp"

#include <catch2/catch.hpp>

using namespace mfem;
using namespace synovia;

namespace
{
constexpr real_t young = 0.5;
constexpr real_t poisson = 0.1;
constexpr real_t permeability_value = 4e-3;
const char *const sides[6] = {"z0", "y0", "x1", "y1", "x0", "z1"};

struct Placed
{
   std::string name;
   BoxOptions box;
   Point3 at{{0.0, 0.0, 0.0}};
};

/// Boxes that share nothing, each with a region and boundaries of its name.
NamedMesh Place(const std::vector<Placed> &boxes)
{
   std::vector<Mesh> meshes;
   std::vector<Mesh *> pointers;
   NameTable regions;
   NameTable boundaries;
   meshes.reserve(boxes.size());
   for (size_t b = 0; b < boxes.size(); b++)
   {
      const int number = static_cast<int>(b);
      meshes.push_back(MakeBoxMesh(boxes[b].box));
      Mesh &mesh = meshes.back();
      for (int i = 0; i < mesh.GetNV(); i++)
      {
         for (int d = 0; d < 3; d++)
         {
            mesh.GetVertex(i)[d] += boxes[b].at[d];
         }
      }
      for (int i = 0; i < mesh.GetNE(); i++)
      {
         mesh.SetAttribute(i, number + 1);
      }
      for (int i = 0; i < mesh.GetNBE(); i++)
      {
         mesh.SetBdrAttribute(i, mesh.GetBdrAttribute(i) + 6 * number);
      }
      mesh.SetAttributes();
      pointers.push_back(&mesh);
      regions[boxes[b].name] = {number + 1};
      for (int i = 0; i < 6; i++)
      {
         boundaries[boxes[b].name + "_" + sides[i]] = {6 * number + i + 1};
      }
   }
   Mesh mesh(pointers.data(), static_cast<int>(pointers.size()));
   return DistributeMesh(mesh, regions, boundaries, MPI_COMM_WORLD);
}

/// Columns on top of each other, rollers at their sides, pressed from above;
/// the reaction of the top in each step.
std::vector<real_t> Columns(int count)
{
   constexpr real_t height = 1.5;
   const int cells[3] = {5, 4, 6};
   std::vector<Placed> boxes;
   for (int i = 0; i < count; i++)
   {
      Placed column;
      column.name = "column" + std::to_string(i);
      column.box.size_x = column.box.size_y = 0.3;
      column.box.size_z = height / count;
      column.box.nx = column.box.ny = 2 + i % 2;
      column.box.nz = count == 1 ? 15 : cells[i];
      column.at[2] = i * height / count;
      boxes.push_back(column);
   }
   NamedMesh mesh = Place(boxes);
   const IsotropicElastic solid(young, poisson);
   const ConstantPermeability permeability(permeability_value);
   BiphasicProblem problem(mesh, SpaceOptions());
   for (const Placed &column : boxes)
   {
      problem.SetMaterial(column.name, solid, permeability);
      problem.PrescribeDisplacement(column.name + "_x0", 0, 0.0);
      problem.PrescribeDisplacement(column.name + "_x1", 0, 0.0);
      problem.PrescribeDisplacement(column.name + "_y0", 1, 0.0);
      problem.PrescribeDisplacement(column.name + "_y1", 1, 0.0);
   }
   for (int i = 1; i < count; i++)
   {
      // Upwards: each column but the ends is source and destination.
      problem.AddContact(boxes[i].name + "_z0", boxes[i - 1].name + "_z1");
   }
   const std::string top = boxes.back().name + "_z1";
   problem.PrescribeDisplacement("column0_z0", 2, 0.0);
   problem.PrescribeDisplacement(top, 2, Ramp(100.0, -0.05));
   problem.PrescribePressure(top, 0.0);
   TimeOptions times;
   times.step = 25.0;
   times.end = 200.0;
   TimeStepper stepper(problem, times);
   std::vector<real_t> forces;
   while (!stepper.Done())
   {
      const StepReport report = stepper.Step();
      INFO(report.reason);
      REQUIRE(report.converged);
      real_t force = 0.0;
      for (const BiphasicProblem::Support &support : problem.Supports())
      {
         if (support.boundary == top)
         {
            force = problem.Reaction(support)[2];
         }
      }
      forces.push_back(force);
   }
   return forces;
}
} // namespace

TEST_CASE("Three columns in contact are one of triple height")
{
   const std::vector<real_t> three = Columns(3);
   const std::vector<real_t> one = Columns(1);
   REQUIRE(three.size() == 8);
   REQUIRE(one.size() == 8);
   for (size_t i = 0; i < one.size(); i++)
   {
      CHECK(three[i] == Approx(one[i]).epsilon(5e-3));
      CHECK(one[i] < -1e-4);
   }
}

TEST_CASE("A surface is destination in one pair and source in another")
{
   Placed plate;
   plate.name = "plate";
   plate.box.nx = 12;
   plate.box.ny = 5;
   plate.box.nz = 2;
   plate.box.size_x = 2.0;
   plate.box.size_z = 0.4;
   Placed left;
   left.name = "left";
   left.box.nx = left.box.ny = 3;
   left.box.nz = 2;
   left.box.size_x = 0.6;
   left.box.size_z = 0.3;
   left.at = {0.2, 0.0, 0.4};
   Placed right(left);
   right.name = "right";
   right.at = {1.2, 0.0, 0.4};
   NamedMesh mesh = Place({plate, left, right});
   const IsotropicElastic solid(young, poisson);
   const ConstantPermeability permeability(permeability_value);
   BiphasicProblem problem(mesh, SpaceOptions());
   for (const std::string body : {"plate", "left", "right"})
   {
      problem.SetMaterial(body, solid, permeability);
   }
   problem.FixDisplacement("plate_z0");
   for (const std::string body : {"left", "right"})
   {
      problem.PrescribeDisplacement(body + "_z1", 0, 0.0);
      problem.PrescribeDisplacement(body + "_z1", 1, 0.0);
      problem.PrescribeDisplacement(body + "_z1", 2, Ramp(20.0, -0.02));
   }
   problem.AddContact("left_z0", "plate_z1");
   problem.AddContact("plate_z1", "right_z0");
   TimeOptions times;
   times.step = 5.0;
   times.end = 20.0;
   TimeStepper stepper(problem, times);
   while (!stepper.Done())
   {
      const StepReport report = stepper.Step();
      INFO(report.reason);
      REQUIRE(report.converged);
   }
   const std::vector<ContactPair *> &pairs = problem.Operator().Pairs();
   const ContactDiagnostics on_left = Diagnose(*pairs[0]);
   const ContactDiagnostics on_right = Diagnose(*pairs[1]);
   const real_t force = -on_left.destination_force[2];
   REQUIRE(force > 1e-3);
   // Which side is integrated over matters as much as the mesh does.
   CHECK(on_right.destination_force[2] == Approx(force).epsilon(0.03));
   CHECK(on_right.peak_traction > 0.0);

   // Pressure on the plate's top: the contact seals, the rest drains.
   const ContactSurface &top = pairs[0]->Geometry().Destination();
   FunctionCoefficient x_of([](const Vector &x) { return x[0]; });
   ParGridFunction position(&problem.Spaces().Pressure());
   position.ProjectCoefficient(x_of);
   Vector x;
   position.GetTrueDofs(x);
   const Vector &p = stepper.State().GetBlock(1);
   real_t under_left = 0.0;
   real_t under_right = 0.0;
   real_t elsewhere = 0.0;
   int looked_at = 0;
   for (const int dof : top.PressureTrueDofs())
   {
      looked_at++;
      const bool left_of = x[dof] > 0.2 + 0.17 && x[dof] < 0.8 - 0.17;
      const bool right_of = x[dof] > 1.2 + 0.17 && x[dof] < 1.8 - 0.17;
      const bool outside = x[dof] < 0.2 - 1e-6 ||
                           (x[dof] > 0.8 + 1e-6 && x[dof] < 1.2 - 1e-6) ||
                           x[dof] > 1.8 + 1e-6;
      under_left = std::max(under_left, left_of ? p[dof] : 0.0);
      under_right = std::max(under_right, right_of ? p[dof] : 0.0);
      elsewhere = std::max(elsewhere, outside ? std::abs(p[dof]) : 0.0);
   }
   const MPI_Comm comm = mesh.GetComm();
   under_left = MaxOverRanks(under_left, comm);
   under_right = MaxOverRanks(under_right, comm);
   CHECK(SumOverRanks(looked_at, comm) == 13 * 6);
   CHECK(under_left > 1e-4);
   CHECK(under_right == Approx(under_left).epsilon(0.1));
   CHECK(MaxOverRanks(elsewhere, comm) == 0.0);
}
