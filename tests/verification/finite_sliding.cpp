// ranks: 2
// timeout: 600
//
// A block with a round underside that is pressed into a layer and slides over
// 20 of its faces, in plane strain and drained, far from the layer's ends: the
// force that presses it stays the same, face edges or not. Without friction
// nothing holds it back; with friction the force that does stays the same as
// well, once all of the contact slides, and all of its work is lost: over a
// face of the layer both bodies come by the state that they were in.

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
#include <vector>

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

namespace
{
/// Of the steps from the one on that presses the block.
struct SlideHistory
{
   /// Forces on the block (force): up, and along its way.
   std::vector<real_t> pressed;
   std::vector<real_t> along;
   /// Work of friction since the run began, and the part of the contact that
   /// slides.
   std::vector<real_t> dissipation;
   std::vector<real_t> sliding;
   /// Of all steps: the most iterations of Newton's method, and attempts that
   /// failed.
   int most_newton = 0;
   int failures = 0;
};

SlideHistory Slide(real_t friction)
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
   ContactOptions contact;
   contact.friction = {friction, 1.0};
   problem.AddContact("lower_z1", "upper_z0", contact);
   TimeOptions times;
   times.end = end;
   times.step = long_time;
   TimeStepper stepper(problem, times);
   SlideHistory slide;
   while (!stepper.Done())
   {
      const StepReport report = stepper.Step();
      INFO(report.reason);
      REQUIRE(report.converged);
      slide.failures += report.failures;
      slide.most_newton = std::max(slide.most_newton, report.solve.newton);
      if (stepper.Time() < pressed - 1e-6 * long_time)
      {
         continue;
      }
      const ContactDiagnostics now =
         Diagnose(*problem.Operator().Pairs().front());
      slide.pressed.push_back(now.destination_force[2]);
      slide.along.push_back(now.destination_force[0]);
      slide.dissipation.push_back(now.friction.dissipation);
      slide.sliding.push_back(now.friction.sliding);
   }
   return slide;
}

/// How much more the largest is than the smallest one, as a part of that, from
/// a step on.
real_t Spread(const std::vector<real_t> &values, int from)
{
   const auto [least, most] =
      std::minmax_element(values.begin() + from, values.end());
   return (*most - *least) / std::min(std::abs(*least), std::abs(*most));
}
} // namespace

TEST_CASE("A block that slides over 20 faces is pressed by the same force")
{
   const SlideHistory slide = Slide(0.0);
   CHECK(slide.pressed.front() > 0.0);
   CHECK(Spread(slide.pressed, 0) <= 1e-3);
   for (const real_t force : slide.along)
   {
      CHECK(std::abs(force) <= 1e-3 * slide.pressed.front());
   }
}

TEST_CASE("Friction holds it back by the same force on each of them")
{
   constexpr real_t mu = 0.3;
   const SlideHistory slide = Slide(mu);
   CHECK(slide.failures == 0);
   // In the step in which all of it lets go; others take 4 to 6.
   CHECK(slide.most_newton <= 9);
   const auto &all = slide.sliding;
   const int from =
      static_cast<int>(std::find(all.begin(), all.end(), 1.0) - all.begin());
   // Within the first two faces.
   REQUIRE(from <= 2 * steps_per_face);
   const int last = static_cast<int>(all.size()) - 1;
   for (int i = 1; i <= last; i++)
   {
      CAPTURE(i, slide.pressed[i], slide.along[i]);
      CHECK(slide.dissipation[i] >= slide.dissipation[i - 1]);
      CHECK((i < from || all[i] == 1.0));
   }
   CAPTURE(slide.pressed, slide.along);
   CHECK(Spread(slide.pressed, from) <= 0.01);
   CHECK(Spread(slide.along, from) <= 0.01);
   // By whole faces, at whose ends the deformation is the same.
   const int begin = last - (last - from) / steps_per_face * steps_per_face;
   real_t work = 0.0;
   for (int i = begin + 1; i <= last; i++)
   {
      work -= slide.along[i] * face / steps_per_face;
   }
   CHECK(slide.dissipation[last] - slide.dissipation[begin] ==
         Approx(work).epsilon(0.01));
}
