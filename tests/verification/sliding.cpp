// ranks: 1 2 3
//
// A block with a round bottom is pressed into a layer and slides over several
// of its faces, which look for their partners on the deformed surfaces. Once
// all fluid has drained nothing remembers the way: forces and tractions are
// those of a block that was meshed where the other one arrives.

#include "support/boxes.hpp"
#include "synovia/synovia.hpp"

#include <catch2/catch.hpp>

#include <cmath>

using namespace mfem;
using namespace synovia;

namespace
{
constexpr int layer_faces = 12;
constexpr real_t layer_length = 6.0;
constexpr real_t block_length = 2.0;
constexpr real_t block_height = 1.0;
constexpr real_t radius = 4.0;
constexpr real_t start = 0.6;
// 5.3 faces of the layer.
constexpr real_t way = 2.65;
constexpr real_t descent = 0.08;
// Thousands of gel times.
constexpr real_t long_time = 1e8;

struct Slide
{
   ContactNormal normal = ContactNormal::destination;
   SearchConfiguration configuration = SearchConfiguration::current;
   /// Of the block as meshed, from the layer's end, and how far it slides.
   real_t from = start;
   real_t by = way;
};

struct Outcome
{
   Point3 force{{0.0, 0.0, 0.0}};
   real_t moment = 0.0;
   real_t area = 0.0;
   real_t peak_traction = 0.0;
   int searches = 0;
};

NamedMesh MakeBodies(real_t from)
{
   BoxOptions layer;
   layer.nx = layer_faces;
   layer.ny = 1;
   layer.nz = 1;
   layer.size_x = layer_length;
   BoxOptions block = layer;
   block.nx = 5;
   block.size_x = block_length;
   block.size_z = block_height;
   Mesh mesh = MakeStackMesh(layer, block);
   const int below = (layer.nx + 1) * (layer.ny + 1) * (layer.nz + 1);
   for (int i = below; i < mesh.GetNV(); i++)
   {
      real_t *const x = mesh.GetVertex(i);
      const real_t part = (layer.size_z + block_height - x[2]) / block_height;
      const real_t arm = x[0] - 0.5 * block_length;
      x[2] += part * arm * arm / (2.0 * radius);
      x[0] += from;
   }
   return DistributeStack(mesh, MPI_COMM_WORLD);
}

Outcome Run(const Slide &slide)
{
   NamedMesh mesh = MakeBodies(slide.from);
   const IsotropicElastic layer(0.7, 0.2);
   const IsotropicElastic block(2.0, 0.3);
   const ConstantPermeability fluid(4e-3);
   BiphasicProblem problem(mesh, SpaceOptions());
   problem.SetMaterial("lower", layer, fluid);
   problem.SetMaterial("upper", block, fluid);
   problem.FixDisplacement("lower_z0");
   for (const char *side : {"lower_y0", "lower_y1", "upper_y0", "upper_y1"})
   {
      problem.PrescribeDisplacement(side, 1, 0.0);
   }
   problem.PrescribePressure("lower_z0", 0.0);
   problem.PrescribePressure("upper_z1", 0.0);
   problem.PrescribeDisplacement(
      "upper_z1", 0,
      LoadCurve({0.0, long_time, 5.0 * long_time}, {0.0, 0.0, slide.by}));
   problem.PrescribeDisplacement("upper_z1", 1, 0.0);
   problem.PrescribeDisplacement("upper_z1", 2,
                                 LoadCurve({0.0, long_time}, {0.0, -descent}));
   ContactOptions contact;
   contact.normal = slide.normal;
   contact.configuration = slide.configuration;
   contact.gap_tolerance = 1e-9;
   contact.search_radius = 1.0;
   problem.AddContact("upper_z0", "lower_z1", contact);
   NonlinearOptions nonlinear;
   nonlinear.linear.method = LinearMethod::direct;
   nonlinear.linear.relative_tolerance = 1e-12;
   problem.SetNonlinearOptions(nonlinear);

   TimeOptions times;
   times.step = long_time;
   times.end = 6.0 * long_time;
   times.cut_back = false;
   TimeStepper stepper(problem, times);
   Outcome outcome;
   while (!stepper.Done())
   {
      const StepReport report = stepper.Step();
      CAPTURE(stepper.Steps(), report.reason);
      REQUIRE(report.converged);
      outcome.searches += report.solve.searches;
   }
   const ContactDiagnostics now = Diagnose(*problem.Operator().Pairs().front());
   outcome.force = now.destination_force;
   outcome.moment = now.destination_moment[1];
   outcome.area = now.area;
   outcome.peak_traction = now.peak_traction;
   return outcome;
}

// Of forces, relative to the force that presses.
real_t Difference(const Outcome &one, const Outcome &other)
{
   return Length(Sum(one.force, -1.0, other.force)) / Length(other.force);
}
} // namespace

TEST_CASE("A block that slides ends as one that was meshed there")
{
   Slide slide;
   slide.normal = GENERATE(ContactNormal::destination, ContactNormal::mean);
   const Outcome slid = Run(slide);
   Slide there = slide;
   there.from = start + way;
   there.by = 0.0;
   const Outcome reference = Run(there);
   CHECK(reference.force[2] < -0.01);
   CHECK(slid.searches > 4);
   // Ten times what has been seen: the last displacement that partners were
   // looked for at depends a little on the way.
   CHECK(Difference(slid, reference) <= 5e-5);
   CHECK(slid.moment == Approx(reference.moment).epsilon(1e-4));
   CHECK(slid.area == Approx(reference.area).epsilon(1e-4));
   CHECK(slid.peak_traction == Approx(reference.peak_traction).epsilon(5e-3));

   // Partners of the surfaces as meshed are left behind.
   slide.configuration = SearchConfiguration::reference;
   CHECK(Difference(Run(slide), reference) > 1e-2);
}
