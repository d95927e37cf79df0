// ranks: 1 2
//
// Two thin layers bonded to rigid bones, one of which is a paraboloid: contact
// of articular cartilage (Ateshian et al., J Biomech 27:1347-1360, 1994). With
// 1/R the relative curvature, h, mu, kappa of each layer, and a >> h,
// incompressible layers squeeze out sideways as a lubricant would: to each of
// them h^3/(3 mu) lap p is minus what its thickness loses, so that together
//
//     p(r) = 3/(32 R S) (a^2 - r^2)^2,  S = sum h^3/mu,
//     P = pi a^6 / (32 R S),  delta = a^2/(4 R),  int p r^2 / int p = a^2/4.
//
// Fluid that flows along the layers adds h kappa lap p to the rate of what they
// lose. With layers alike, chi = 3 mu kappa/h^2, and a constant load,
//
//     P (1 + chi t) = pi a^6 / (32 R S).
//
// Deviations are of the order of h/a.

#include "support/traction_moments.hpp"
#include "synovia/synovia.hpp"

#include <catch2/catch.hpp>

#include <cmath>

using namespace mfem;
using namespace synovia;

namespace
{
const real_t pi = 4.0 * std::atan(1.0);
/// Of the contact that the approach below makes.
constexpr real_t radius = 1.0;
constexpr real_t curvature_radius = 400.0;
constexpr real_t extent = 1.35;
constexpr int sectors = 2;
constexpr real_t permeability = 1e-3;

struct Layer
{
   real_t thickness = 0.05;
   /// Shear modulus; Poisson's ratio is zero.
   real_t shear = 0.25;
   int rings = 40;

   real_t Compliance() const { return std::pow(thickness, 3) / shear; }
};

/// Quarter of a disc with a fan of triangles at the center and rings of
/// quadrilaterals around it, thickness 1.
Mesh MakeDisc(const Layer &layer)
{
   constexpr int through = 2;
   const real_t angle = 0.5 * pi / sectors;
   Mesh flat(2, 0, 0);
   flat.AddVertex(0.0, 0.0);
   for (int i = 1; i <= layer.rings; i++)
   {
      const real_t r = extent * i / layer.rings;
      for (int j = 0; j <= sectors; j++)
      {
         flat.AddVertex(r * std::cos(j * angle), r * std::sin(j * angle));
      }
   }
   const auto vertex = [](int ring, int j)
   { return 1 + (ring - 1) * (sectors + 1) + j; };
   for (int j = 0; j < sectors; j++)
   {
      flat.AddTriangle(0, vertex(1, j), vertex(1, j + 1));
      for (int i = 1; i < layer.rings; i++)
      {
         flat.AddQuad(vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1),
                      vertex(i, j + 1));
      }
   }
   flat.FinalizeTopology();
   flat.Finalize();
   const std::unique_ptr<Mesh> mesh(Extrude2D(&flat, through, 1.0));
   for (int i = 0; i < mesh->GetNBE(); i++)
   {
      Array<int> vertices;
      mesh->GetBdrElementVertices(i, vertices);
      Vector low(3);
      Vector high(3);
      low = 1e9;
      high = -1e9;
      for (const int v : vertices)
      {
         for (int d = 0; d < 3; d++)
         {
            low[d] = std::min(low[d], mesh->GetVertex(v)[d]);
            high[d] = std::max(high[d], mesh->GetVertex(v)[d]);
         }
      }
      const bool level = high[2] - low[2] < 1e-9;
      mesh->SetBdrAttribute(i, level && low[2] < 0.5 ? 1
                               : level               ? 2
                               : high[0] < 1e-9      ? 3
                               : high[1] < 1e-9      ? 4
                                                     : 5);
   }
   mesh->SetAttributes();
   return Mesh(*mesh);
}

/// Bends chords to arcs.
void Round(real_t &x, real_t &y)
{
   const real_t sector = 0.5 * pi / sectors;
   const real_t angle = std::atan2(y, x);
   const real_t j = std::min(std::floor(angle / sector), sectors - 1.0);
   const real_t factor =
      std::cos(angle - (j + 0.5) * sector) / std::cos(0.5 * sector);
   x *= factor;
   y *= factor;
}

NamedMesh MakeLayers(const Layer &lower, const Layer &upper)
{
   Mesh below = MakeDisc(lower);
   Mesh above = MakeDisc(upper);
   below.SetCurvature(2);
   above.SetCurvature(2);
   below.Transform(
      [&](const Vector &from, Vector &to)
      {
         to = from;
         Round(to[0], to[1]);
         to[2] = lower.thickness * (from[2] - 1.0);
      });
   above.Transform(
      [&](const Vector &from, Vector &to)
      {
         to = from;
         Round(to[0], to[1]);
         to[2] = upper.thickness * from[2] +
                 (to[0] * to[0] + to[1] * to[1]) / (2.0 * curvature_radius);
      });
   for (int i = 0; i < above.GetNE(); i++)
   {
      above.SetAttribute(i, 2);
   }
   for (int i = 0; i < above.GetNBE(); i++)
   {
      above.SetBdrAttribute(i, 5 + above.GetBdrAttribute(i));
   }
   above.SetAttributes();
   Mesh *layers[] = {&below, &above};
   Mesh mesh(layers, 2);
   return DistributeMesh(mesh, {{"lower", {1}}, {"upper", {2}}},
                         {{"lower_bone", {1}},
                          {"lower_contact", {2}},
                          {"upper_contact", {6}},
                          {"upper_bone", {7}},
                          {"symmetry_x", {3, 8}},
                          {"symmetry_y", {4, 9}},
                          {"rims", {5, 10}}},
                         MPI_COMM_WORLD);
}

struct Contact
{
   real_t force = 0.0;
   /// From the second moment of the traction.
   real_t radius = 0.0;
   /// From the contact area.
   real_t area_radius = 0.0;
};

Contact Measure(BiphasicProblem &problem)
{
   const TractionMoments moments = MeasureTraction(problem);
   const real_t area = ContactArea(*problem.Operator().Pairs().front());
   return {4.0 * moments.force, std::sqrt(4.0 * moments.mean_square_radius),
           std::sqrt(4.0 * area / pi)};
}

/// The layers with their bones; what moves the upper one is to be added.
class Layers
{
public:
   Layers(const Layer &lower, const Layer &upper)
      : mesh(MakeLayers(lower, upper)), lower_solid(2.0 * lower.shear, 0.0),
        upper_solid(2.0 * upper.shear, 0.0), fluid(permeability),
        problem(mesh, SpaceOptions())
   {
      problem.SetMaterial("lower", lower_solid, fluid);
      problem.SetMaterial("upper", upper_solid, fluid);
      problem.FixDisplacement("lower_bone");
      problem.PrescribeDisplacement("upper_bone", 0, 0.0);
      problem.PrescribeDisplacement("upper_bone", 1, 0.0);
      problem.PrescribeDisplacement("symmetry_x", 0, 0.0);
      problem.PrescribeDisplacement("symmetry_y", 1, 0.0);
      problem.PrescribePressure("rims", 0.0);
      problem.AddContact("upper_contact", "lower_contact");
   }
   BiphasicProblem &Problem() { return problem; }

private:
   NamedMesh mesh;
   IsotropicElastic lower_solid;
   IsotropicElastic upper_solid;
   ConstantPermeability fluid;
   BiphasicProblem problem;
};

real_t GelTime(const Layer &layer)
{
   return layer.thickness * layer.thickness /
          (2.0 * layer.shear * permeability);
}

/// Force over that of the theory, for the contact radius and for the approach.
struct Ratios
{
   real_t by_radius = 0.0;
   real_t by_approach = 0.0;
};

Ratios AtOnce(const Layer &lower, const Layer &upper)
{
   Layers layers(lower, upper);
   const real_t approach = radius * radius / (4.0 * curvature_radius);
   layers.Problem().PrescribeDisplacement("upper_bone", 2, -approach);
   TimeOptions times;
   times.step = times.end = 1e-6 * GelTime(lower);
   TimeStepper stepper(layers.Problem(), times);
   const StepReport report = stepper.Step();
   INFO(report.reason);
   REQUIRE(report.converged);
   const Contact contact = Measure(layers.Problem());
   CHECK(contact.area_radius == Approx(contact.radius).epsilon(0.05));
   const real_t scale = pi / (32.0 * curvature_radius *
                              (lower.Compliance() + upper.Compliance()));
   return {contact.force / (scale * std::pow(contact.radius, 6)),
           contact.force / (scale * std::pow(radius, 6))};
}
} // namespace

TEST_CASE("Force of thin layers at once against the contact radius")
{
   Layer lower;
   Layer upper;
   upper.rings = 34;
   SECTION("layers alike") {}
   SECTION("layers unlike")
   {
      upper.thickness = 0.035;
      upper.shear = 0.6;
   }
   const Ratios thick = AtOnce(lower, upper);
   lower.thickness *= 0.5;
   upper.thickness *= 0.5;
   lower.rings = 70;
   upper.rings = 59;
   const Ratios thin = AtOnce(lower, upper);
   CAPTURE(thick.by_radius, thick.by_approach, thin.by_radius,
           thin.by_approach);
   CHECK(std::abs(thin.by_radius - 1.0) <= 0.03);
   CHECK(std::abs(thin.by_radius - 1.0) < std::abs(thick.by_radius - 1.0));
   CHECK(std::abs(thin.by_approach - 1.0) < std::abs(thick.by_approach - 1.0));
}

TEST_CASE("Contact of thin layers under a constant load grows")
{
   Layer lower;
   lower.thickness = 0.025;
   lower.rings = 70;
   Layer upper(lower);
   upper.rings = 59;
   Layers layers(lower, upper);
   const real_t force =
      pi * std::pow(radius, 6) /
      (32.0 * curvature_radius * (lower.Compliance() + upper.Compliance()));
   layers.Problem().DriveByForce({"upper_bone"}, Vector({0.0, 0.0, -1.0}),
                                 0.25 * force);
   const real_t chi =
      3.0 * lower.shear * permeability / (lower.thickness * lower.thickness);
   TimeOptions times;
   times.step = 0.1 / chi;
   times.end = 1.0 / chi;
   TimeStepper stepper(layers.Problem(), times);
   real_t worst = 0.0;
   real_t last_radius = 0.0;
   while (!stepper.Done())
   {
      const StepReport report = stepper.Step();
      INFO(report.reason);
      REQUIRE(report.converged);
      const Contact contact = Measure(layers.Problem());
      CHECK(contact.force == Approx(force).epsilon(1e-6));
      // Also between the steps in which vertices come into contact.
      CHECK(contact.area_radius > last_radius + 1e-3);
      last_radius = contact.area_radius;
      const real_t growth = std::pow(contact.radius / radius, 6);
      CAPTURE(report.time * chi, growth);
      worst =
         std::max(worst, std::abs(growth / (1.0 + chi * report.time) - 1.0));
      CHECK(worst <= 0.05);
   }
   CHECK(stepper.Steps() == 10);
}
