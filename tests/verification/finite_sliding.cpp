// ranks: 1 2
// timeout: 300
//
// A block with a round underside that is pressed into a layer and slides over
// 20 of its faces, in plane strain, without friction and drained, far from the
// layer's ends: the force that presses it stays the same, face edges or not,
// and nothing holds it back.

#include "support/boxes.hpp"
#include "synovia/contact/contact_diagnostics.hpp"
#include "synovia/general/reduce.hpp"
#include "synovia/materials/permeabilities/constant_permeability.hpp"
#include "synovia/materials/solids/neo_hookean.hpp"
#include "synovia/synovia.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <set>

using namespace mfem;
using namespace synovia;

namespace
{
constexpr real_t face = 0.1;
constexpr real_t thickness = 0.3;
constexpr real_t start = 0.8;
constexpr real_t length = 0.5;
constexpr real_t radius = 0.6;
constexpr real_t depth = 0.04;
constexpr int faces = 20;
constexpr int steps_per_face = 3;
// Of a step; thousands of gel times.
constexpr real_t long_time = 1.0e9;

NamedMesh MakeBodies()
{
   BoxOptions layer;
   layer.nx = 40;
   layer.nz = 2;
   layer.size_x = layer.nx * face;
   layer.size_y = face;
   layer.size_z = thickness;
   BoxOptions block = layer;
   block.nx = 6;
   block.size_x = length;
   Mesh mesh = MakeStackMesh(layer, block);
   mesh.SetCurvature(2);
   GridFunction &nodes = *mesh.GetNodes();
   const FiniteElementSpace &space = *nodes.FESpace();
   std::set<int> of_block;
   for (int i = 0; i < mesh.GetNE(); i++)
   {
      if (mesh.GetAttribute(i) == 2)
      {
         Array<int> dofs;
         space.GetElementDofs(i, dofs);
         of_block.insert(dofs.begin(), dofs.end());
      }
   }
   for (const int dof : of_block)
   {
      real_t &x = nodes(space.DofToVDof(dof, 0));
      real_t &z = nodes(space.DofToVDof(dof, 2));
      const real_t off_center = x - 0.5 * length;
      z += 0.5 * off_center * off_center / radius;
      x += start;
   }
   return DistributeStack(mesh, MPI_COMM_WORLD);
}
} // namespace

TEST_CASE("A block that slides over 20 faces is pressed by the same force")
{
   NamedMesh mesh = MakeBodies();
   const NeoHookean layer(0.5, 0.3);
   const NeoHookean block(2.0, 0.3);
   const ConstantPermeability fluid(4.0e-3);
   SpaceOptions space;
   space.deformation = Deformation::finite;
   BiphasicProblem problem(mesh, space);
   problem.SetMaterial("lower", layer, fluid);
   problem.SetMaterial("upper", block, fluid);
   for (const std::string body : {"lower_", "upper_"})
   {
      problem.PrescribeDisplacement(body + "y0", 1, 0.0);
      problem.PrescribeDisplacement(body + "y1", 1, 0.0);
   }
   problem.FixDisplacement("lower_z0");
   const real_t pressed = 2.0 * long_time;
   const int steps = faces * steps_per_face;
   const real_t end = pressed + steps * long_time;
   problem.PrescribeDisplacement(
      "upper_z1", 0, LoadCurve({0.0, pressed, end}, {0.0, 0.0, faces * face}));
   problem.PrescribeDisplacement("upper_z1", 1, 0.0);
   problem.PrescribeDisplacement("upper_z1", 2, Ramp(pressed, -depth));
   problem.PrescribePressure("lower_z0", 0.0);
   problem.PrescribePressure("upper_z1", 0.0);
   problem.AddContact("lower_z1", "upper_z0");
   TimeOptions times;
   times.end = end;
   times.step = long_time;
   TimeStepper stepper(problem, times);
   real_t least = infinity();
   real_t most = 0.0;
   real_t friction = 0.0;
   real_t most_change = 0.0;
   real_t last = 0.0;
   int newton = 0;
   int steps_taken = 0;
   while (!stepper.Done())
   {
      const StepReport report = stepper.Step();
      INFO(report.reason);
      REQUIRE(report.converged);
      newton += report.solve.newton;
      steps_taken += report.solves;
      if (stepper.Time() < pressed - 1e-6 * long_time)
      {
         continue;
      }
      const ContactDiagnostics forces =
         Diagnose(*problem.Operator().Pairs().front());
      const real_t force = forces.destination_force[2];
      least = std::min(least, force);
      most = std::max(most, force);
      friction = std::max(friction, std::abs(forces.destination_force[0]));
      if (last > 0.0)
      {
         most_change = std::max(most_change, std::abs(force - last));
      }
      last = force;
   }
   CAPTURE(least, most, friction, most_change, newton, steps_taken);
   CHECK(least > 0.0);
   CHECK(most <= 1.001 * least);
   CHECK(most_change <= 0.001 * least);
   CHECK(friction <= 0.001 * least);
}
