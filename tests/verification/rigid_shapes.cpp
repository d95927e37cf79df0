// ranks: 1 2 3
// timeout: 600
//
// Rigid bodies without a mesh that press deformable ones.
//
// 1. A plane that compresses a confined column by its travel does what a
//    prescribed displacement does, a square or triangles from an STL file.
// 2. A sphere of radius R on an elastic half-space (Hertz): with E* =
//    E/(1 - nu^2) and the approach d, a^2 = R d and F = 4/3 E* a^3/R. The block
//    of ten contact radii is a quarter; its outer faces move as Boussinesq's
//    half-space does under F (see hertz.cpp). The sphere, under its force
//    alone, starts above the block and finds it.
// 3. A cylinder on a half-space in plane strain, with the force f per length:
//    a^2 = 4 f R/(pi E*) and the largest traction 2 f/(pi a).

#include "support/boxes.hpp"
#include "support/temporary_directory.hpp"
#include "synovia/mesh/shape_mesh.hpp"
#include "synovia/synovia.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <sstream>

using namespace mfem;
using namespace synovia;

namespace
{
NamedMesh WithShape(Mesh &mesh, const RigidShape &shape)
{
   NamedSerialMesh all = AddShapes(mesh, {{"body", {1}}},
                                   {{"z0", {1}},
                                    {"y0", {2}},
                                    {"x1", {3}},
                                    {"y1", {4}},
                                    {"x0", {5}},
                                    {"z1", {6}}},
                                   {shape});
   return DistributeMesh(all.mesh, all.regions, all.boundaries, MPI_COMM_WORLD);
}

/// Free to move along z only.
RigidBodyOptions AlongZ(const Point3 &reference)
{
   RigidBodyOptions options;
   options.reference = reference;
   for (const int fixed : {0, 1, 3, 4, 5})
   {
      options.prescribed[fixed] = 0.0;
   }
   return options;
}

void Confine(BiphasicProblem &problem)
{
   problem.PrescribeDisplacement("z0", 2, 0.0);
   for (const char *name : {"x0", "x1"})
   {
      problem.PrescribeDisplacement(name, 0, 0.0);
   }
   for (const char *name : {"y0", "y1"})
   {
      problem.PrescribeDisplacement(name, 1, 0.0);
   }
}

BoxOptions Column()
{
   BoxOptions box;
   box.nx = box.ny = 2;
   box.nz = 8;
   box.size_x = box.size_y = 0.4;
   return box;
}

struct Laws
{
   IsotropicElastic linear{0.5, 0.1};
   NeoHookean finite{0.5, 0.1};
   ConstantPermeability permeability{4e-3};
};

TimeOptions Times()
{
   TimeOptions times;
   times.step = 20.0;
   times.end = 100.0;
   return times;
}

SpaceOptions Space(bool finite)
{
   SpaceOptions space;
   space.deformation =
      finite ? Deformation::finite : Deformation::infinitesimal;
   return space;
}

// Reactions of the base.
std::vector<real_t> March(BiphasicProblem &problem)
{
   TimeStepper stepper(problem, Times());
   std::vector<real_t> reactions;
   while (!stepper.Done())
   {
      const StepReport report = stepper.Step();
      INFO(report.reason);
      REQUIRE(report.converged);
      reactions.push_back(problem.Reaction(problem.Supports().front())[2]);
   }
   return reactions;
}
} // namespace

namespace
{
// A square of edge 1 that faces down, as triangles of different sizes, in
// another unit.
std::string FacetsOfPlane(const Point3 &center, real_t scale)
{
   constexpr int n = 5;
   const auto corner = [&](int i, int j)
   {
      const bool inside = i > 0 && i < n && j > 0 && j < n;
      const real_t off = inside ? 0.3 / n : 0.0;
      const real_t x = real_t(i) / n - 0.5 + off * std::sin(3.0 * i + 5.0 * j);
      const real_t y = real_t(j) / n - 0.5 + off * std::cos(7.0 * i - 2.0 * j);
      return Point3{
         {(center[0] + x) / scale, (center[1] + y) / scale, center[2] / scale}};
   };
   std::ostringstream out;
   out.precision(17);
   out << "solid plane\n";
   const auto triangle = [&](const Point3 &a, const Point3 &b, const Point3 &c)
   {
      out << "facet normal 0 0 -1\nouter loop\n";
      for (const Point3 &p : {a, b, c})
      {
         out << "vertex " << p[0] << ' ' << p[1] << ' ' << p[2] << '\n';
      }
      out << "endloop\nendfacet\n";
   };
   for (int j = 0; j < n; j++)
   {
      for (int i = 0; i < n; i++)
      {
         const Point3 a = corner(i, j);
         const Point3 b = corner(i + 1, j);
         const Point3 c = corner(i + 1, j + 1);
         const Point3 d = corner(i, j + 1);
         if ((i + j) % 2 == 0)
         {
            triangle(a, c, b);
            triangle(a, d, c);
         }
         else
         {
            triangle(a, d, b);
            triangle(b, d, c);
         }
      }
   }
   out << "endsolid plane\n";
   return out.str();
}
} // namespace

TEST_CASE("A plane compresses a column as a prescribed displacement does")
{
   const bool finite = GENERATE(false, true);
   const bool from_file = GENERATE(false, true);
   CAPTURE(finite, from_file);
   const TemporaryDirectory directory;
   const Laws laws;
   const SolidLaw &solid =
      finite ? static_cast<const SolidLaw &>(laws.finite) : laws.linear;
   const LoadCurve travel = Ramp(60.0, -0.1);
   NamedMesh alone = MakeBox(Column());
   BiphasicProblem prescribed(alone, Space(finite));
   prescribed.SetMaterial("body", solid, laws.permeability);
   Confine(prescribed);
   prescribed.PrescribePressure("z0", 0.0);
   prescribed.PrescribeDisplacement("z1", 2, travel);
   const std::vector<real_t> expected = March(prescribed);

   Mesh box = MakeBoxMesh(Column());
   RigidShape plane;
   plane.name = "platen";
   plane.type = RigidShape::Type::plane;
   plane.center = {0.2, 0.2, 1.0};
   plane.axis = {0.0, 0.0, -2.0};
   plane.edge = 1.0;
   if (from_file)
   {
      plane.type = RigidShape::Type::file;
      plane.scale = 0.01;
      plane.file =
         directory.Write("plane.stl", FacetsOfPlane(plane.center, plane.scale));
   }
   NamedMesh mesh = WithShape(box, plane);
   BiphasicProblem pressed(mesh, Space(finite));
   pressed.SetMaterial("body", solid, laws.permeability);
   Confine(pressed);
   pressed.PrescribePressure("z0", 0.0);
   RigidBodyOptions options = AlongZ(plane.center);
   options.prescribed[2] = travel;
   pressed.AddRigidBody("platen", {}, options, {"platen"});
   ContactOptions contact;
   contact.gap_tolerance = 1e-8;
   pressed.AddContact("platen", "z1", contact);
   const std::vector<real_t> reactions = March(pressed);
   const auto state = pressed.RigidBodyStates().front();
   for (size_t i = 0; i < expected.size(); i++)
   {
      CHECK(reactions[i] == Approx(expected[i]).epsilon(1e-5));
   }
   CHECK(state.pose[2] == Approx(-0.1));
   CHECK(state.force[2] == Approx(-reactions.back()).epsilon(1e-7));
}

namespace
{
constexpr real_t young = 1.0;
constexpr real_t poisson = 0.3;
constexpr real_t radius = 20.0;
constexpr real_t a = 1.0;
constexpr real_t size = 10.0;
constexpr real_t modulus = young / (1.0 - poisson * poisson);

real_t HertzForce()
{
   return 4.0 / 3.0 * modulus * a * a * a / radius;
}

// Uniform where the contact is, then growing to the size at s = 1.
real_t Graded(real_t s)
{
   constexpr real_t part = 0.55;
   constexpr real_t slope = 1.3 / part;
   constexpr real_t rest = 1.0 - part;
   const real_t beyond = std::max(s - part, 0.0);
   return slope * s +
          (size - slope) / (rest * rest * rest) * beyond * beyond * beyond;
}

// The half-space's displacement under the force.
void FarField(const Vector &x, Vector &u)
{
   const real_t mu = young / (2.0 * (1.0 + poisson));
   const real_t scale = HertzForce() / (4.0 * M_PI * mu);
   const real_t depth = -x[2];
   const real_t r = std::hypot(x[0], x[1]);
   const real_t rho = std::hypot(r, depth);
   const real_t outward =
      scale * (depth / (rho * rho * rho) -
               (1.0 - 2.0 * poisson) / (rho * (rho + depth)));
   u[0] = outward * x[0];
   u[1] = outward * x[1];
   u[2] = -scale *
          (depth * depth / (rho * rho * rho) + 2.0 * (1.0 - poisson) / rho);
}

Mesh Block(int cells, int across)
{
   BoxOptions box;
   box.nx = box.nz = cells;
   box.ny = across;
   Mesh mesh = MakeBoxMesh(box);
   for (int i = 0; i < mesh.GetNV(); i++)
   {
      real_t *const x = mesh.GetVertex(i);
      x[0] = Graded(x[0]);
      x[1] = across == cells ? Graded(x[1]) : x[1];
      x[2] = -Graded(1.0 - x[2]);
   }
   return mesh;
}
} // namespace

TEST_CASE("A sphere that falls on an elastic block makes Hertz's contact")
{
   Mesh block = Block(9, 9);
   RigidShape sphere;
   sphere.name = "sphere";
   sphere.type = RigidShape::Type::sphere;
   const real_t above = 0.2;
   sphere.center = {0.0, 0.0, radius + above};
   sphere.radius = radius;
   NamedMesh mesh = WithShape(block, sphere);
   const IsotropicElastic solid(young, poisson);
   BiphasicProblem problem(mesh, SpaceOptions());
   problem.SetMaterial("body", solid);
   VectorFunctionCoefficient far_field(3, FarField);
   for (const char *face : {"x1", "y1", "z0"})
   {
      problem.Conditions().PrescribeDisplacement(mesh.Boundary(face),
                                                 far_field);
   }
   problem.PrescribeDisplacement("x0", 0, 0.0);
   problem.PrescribeDisplacement("y0", 1, 0.0);
   RigidBodyOptions options = AlongZ(sphere.center);
   options.load[2] = -0.25 * HertzForce();
   problem.AddRigidBody("sphere", {}, options, {"sphere"});
   problem.AddContact("sphere", "z1");
   TimeOptions times;
   times.step = times.end = 1.0;
   TimeStepper stepper(problem, times);
   const StepReport report = stepper.Step();
   INFO(report.reason);
   REQUIRE(report.converged);
   REQUIRE(problem.Operator().Start().moves.size() == 1);
   CHECK(problem.Operator().Start().moves.front().distance ==
         Approx(above).margin(1e-3));
   const auto state = problem.RigidBodyStates().front();
   const ContactDiagnostics now = Diagnose(*problem.Operator().Pairs().front());
   CHECK(state.pose[2] + above == Approx(-a * a / radius).epsilon(0.01));
   CHECK(std::sqrt(4.0 * now.area / M_PI) == Approx(a).epsilon(0.04));
   CHECK(now.destination_force[2] ==
         Approx(-0.25 * HertzForce()).epsilon(1e-7));
   CHECK(Length(Sum(now.source_force, 1.0, now.destination_force)) <
         1e-8 * HertzForce());
   CHECK(state.force[2] == Approx(-0.25 * HertzForce()).epsilon(1e-8));
}

TEST_CASE("A cylinder on an elastic block makes Hertz's line contact")
{
   Mesh block = Block(24, 1);
   RigidShape cylinder;
   cylinder.name = "roller";
   cylinder.type = RigidShape::Type::cylinder;
   cylinder.center = {0.0, 0.5, radius};
   cylinder.axis = {0.0, 1.0, 0.0};
   cylinder.radius = radius;
   cylinder.height = 2.0;
   NamedMesh mesh = WithShape(block, cylinder);
   const IsotropicElastic solid(young, poisson);
   BiphasicProblem problem(mesh, SpaceOptions());
   problem.SetMaterial("body", solid);
   problem.FixDisplacement("z0");
   problem.PrescribeDisplacement("x0", 0, 0.0);
   problem.PrescribeDisplacement("y0", 1, 0.0);
   problem.PrescribeDisplacement("y1", 1, 0.0);
   const real_t force = 0.25 * M_PI * modulus * a * a / radius;
   RigidBodyOptions options = AlongZ(cylinder.center);
   // On a half of the contact.
   options.load[2] = -0.5 * force;
   problem.AddRigidBody("roller", {}, options, {"roller"});
   problem.AddContact("roller_side", "z1");
   TimeOptions times;
   times.step = times.end = 1.0;
   TimeStepper stepper(problem, times);
   const StepReport report = stepper.Step();
   INFO(report.reason);
   REQUIRE(report.converged);
   const ContactDiagnostics now = Diagnose(*problem.Operator().Pairs().front());
   CHECK(now.area == Approx(a).epsilon(0.05));
   CHECK(now.peak_traction == Approx(2.0 * force / (M_PI * a)).epsilon(0.02));
   CHECK(now.destination_force[2] == Approx(-0.5 * force).epsilon(1e-7));
}

TEST_CASE("A rigid body that meets nothing, or that is to bear multipliers")
{
   Mesh box = MakeBoxMesh(Column());
   RigidShape sphere;
   sphere.name = "ball";
   sphere.type = RigidShape::Type::sphere;
   sphere.center = {5.0, 0.2, 2.0};
   sphere.radius = 0.5;
   sphere.facet_size = 0.25;
   NamedMesh mesh = WithShape(box, sphere);
   const Laws laws;
   BiphasicProblem problem(mesh, SpaceOptions());
   problem.SetMaterial("body", laws.linear, laws.permeability);
   Confine(problem);
   RigidBodyOptions options = AlongZ(sphere.center);
   options.load[2] = -1.0;
   problem.AddRigidBody("ball", {}, options, {"ball"});
   SECTION("nothing is below")
   {
      problem.AddContact("ball", "z1");
      CHECK_THROWS_WITH(problem.Operator(),
                        Catch::Contains("nothing resists the force on "
                                        "\"ball\""));
   }
   SECTION("it is the destination")
   {
      problem.AddContact("z1", "ball");
      CHECK_THROWS_WITH(problem.Operator(),
                        Catch::Contains("its destination is a rigid body"));
   }
}
