// ranks: 1 2 3
//
// The smooth part of a pressure, for the stabilization: all of a linear field,
// nothing of an oscillation or of a layer thinner than an element.

#include "synovia/fem/smooth_stabilization.hpp"
#include "support/boxes.hpp"
#include "synovia/fem/pressure_projection_integrator.hpp"
#include "synovia/general/reduce.hpp"
#include "synovia/synovia.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <functional>

using namespace mfem;
using namespace synovia;

namespace
{
constexpr int cells = 6;

BoxOptions Cubes(Element::Type type)
{
   BoxOptions options;
   options.nx = options.ny = options.nz = cells;
   options.type = type;
   return options;
}

struct LayerBody
{
   explicit LayerBody(Element::Type type)
      : mesh(MakeBox(Cubes(type))), solid(0.5, 0.2), permeability(4.0e-3),
        problem(mesh, FirstOrder())
   {
      problem.SetMaterial("body", solid, permeability);
      ParBilinearForm form(&problem.Spaces().Pressure());
      form.AddDomainIntegrator(
         new PressureProjectionIntegrator(problem.Materials()));
      form.Assemble();
      form.Finalize();
      stabilization.reset(form.ParallelAssemble());
   }

   static SpaceOptions FirstOrder()
   {
      SpaceOptions options;
      options.order = 1;
      return options;
   }

   Vector Project(const std::function<real_t(const Vector &)> &field)
   {
      ParGridFunction p(&problem.Spaces().Pressure());
      FunctionCoefficient coefficient(field);
      p.ProjectCoefficient(coefficient);
      Vector x;
      p.GetTrueDofs(x);
      return x;
   }

   /// |S p_smooth|, |S p - S p_smooth| and |S p|.
   std::array<real_t, 3>
   Measure(const std::function<real_t(const Vector &)> &field)
   {
      const Vector p = Project(field);
      Vector whole(p.Size());
      stabilization->Mult(p, whole);
      Vector smooth;
      SmoothStabilization(problem.Spaces(), problem.Materials())
         .Mult(p, smooth);
      CHECK(std::abs(SumOverRanks(smooth.Sum(), MPI_COMM_WORLD)) < 1e-12);
      Vector rest(whole);
      rest -= smooth;
      const auto norm = [](const Vector &x)
      { return std::sqrt(InnerProduct(MPI_COMM_WORLD, x, x)); };
      return {norm(smooth), norm(rest), norm(whole)};
   }

   NamedMesh mesh;
   IsotropicElastic solid;
   ConstantPermeability permeability;
   BiphasicProblem problem;
   std::unique_ptr<HypreParMatrix> stabilization;
};

int Layer(real_t x)
{
   return static_cast<int>(std::lround(cells * x));
}
} // namespace

TEST_CASE("The smooth part tells a gradient from an oscillation")
{
   const auto type =
      GENERATE(Element::HEXAHEDRON, Element::WEDGE, Element::TETRAHEDRON);
   CAPTURE(static_cast<int>(type));
   LayerBody body(type);

   const auto linear =
      body.Measure([](const Vector &x) { return 1.0 + x[0] - 2.0 * x[2]; });
   CHECK(linear[2] > 1e-3);
   CHECK(linear[1] < 1e-12);

   const auto alternating = body.Measure(
      [](const Vector &x) { return Layer(x[2]) % 2 == 0 ? 1.0 : -1.0; });
   CHECK(alternating[2] > 1e-3);
   CHECK(alternating[0] < 1e-12 * alternating[2]);

   const auto drained = body.Measure([](const Vector &x)
                                     { return Layer(x[2]) == 0 ? 0.0 : 1.0; });
   CHECK(drained[2] > 1e-3);
   CHECK(drained[0] < 1e-12 * drained[2]);
}

TEST_CASE("Of a curved pressure nearly all is smooth, and it scales")
{
   LayerBody body(Element::HEXAHEDRON);
   const auto field = [](const Vector &x) { return std::sin(0.5 * x[0]); };
   const auto curved = body.Measure(field);
   CHECK(curved[1] < 0.1 * curved[2]);
   const auto scaled =
      body.Measure([&](const Vector &x) { return -3.0 * field(x); });
   CHECK(scaled[0] == Approx(3.0 * curved[0]).epsilon(1e-12));
}
