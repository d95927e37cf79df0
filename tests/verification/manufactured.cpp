// ranks: 1 2 3
// timeout: 240
//
// Manufactured solutions: u = f(t) U(x) and p = g(t) P(x) are chosen on the
// unit cube, and body force, fluid source and boundary values follow from
//
//    b = grad p - div(C:eps(u)),    s = div(du/dt) - kappa laplace(p).
//
// Displacement is prescribed on four sides, traction on two; pressure on two
// sides, flux on four; so all that takes a coefficient is used.
//
// Space. With f = g = t one step of backward Euler from rest is exact in time,
// and what is left is the error in space, in L2:
//
//                              u       p
//    order k >= 3            k + 1      k
//    order 2, undrained        3        2    as for Stokes' equations
//    order 2, drained          2        2
//    order 1, stabilized       2     >= 1
//
// Why: in the drained limit p is decoupled from u and obeys Poisson's equation.
// Its error in the norm of H^-1, which drives the error of u in L2, gains
// min(1, k - 2) orders on that in L2: nothing for linear elements, as has been
// measured for all three shapes. The order 3 needs a dual solution in H2, which
// an edge between a side with prescribed displacement and one with traction
// does not have (2.7 has been measured), so displacement is prescribed all
// around there.
//
// Time. U is quadratic and P linear, so that quadratic displacement and linear
// pressure have no error in space on straight elements. With m = B u, the
// fluid's volume, the semi-discrete equations are m' = s - L p with (u, p)
// given by m and t through K u - B^T p = b(t), B u = m: a
// differential-algebraic system of index 1, whose algebraic part is linear.
// Stiffly accurate schemes, which all here are, satisfy it at the end of each
// step and have their full order in u and p. These are orders for kappa dt
// H_A/h^2 of the order of one or less. For larger ones the order of SDIRK33 is
// reduced to between 1.4 and 2 (measured with kappa = 10), in u and p alike, as
// boundary values and loads that depend on time do with all schemes whose
// stages have order 1; those of the others are not.

#include "support/march.hpp"
#include "synovia/synovia.hpp"

#include <catch2/catch.hpp>

#include <array>
#include <cmath>
#include <functional>

using namespace mfem;
using namespace synovia;

namespace
{
constexpr real_t young = 1.3;
constexpr real_t poisson = 0.25;
constexpr real_t mu = young / (2.0 * (1.0 + poisson));
constexpr real_t lambda =
   young * poisson / ((1.0 + poisson) * (1.0 - 2.0 * poisson));

/// Shapes in space of the solution, and what the equations need of them.
class Shapes
{
public:
   virtual ~Shapes() = default;
   virtual void U(const Vector &x, Vector &value) const = 0;
   /// gradient(i, j) = d U_i/d x_j
   virtual void GradU(const Vector &x, DenseMatrix &gradient) const = 0;
   virtual void LaplaceU(const Vector &x, Vector &value) const = 0;
   virtual void GradDivU(const Vector &x, Vector &value) const = 0;
   virtual real_t P(const Vector &x) const = 0;
   virtual void GradP(const Vector &x, Vector &value) const = 0;
   virtual real_t LaplaceP(const Vector &x) const = 0;
};

/// U_i = A_i sin(a.x + i), P = B cos(b.x)
class Waves : public Shapes
{
public:
   void U(const Vector &x, Vector &value) const override
   {
      for (int i = 0; i < 3; i++)
      {
         value[i] = amplitude[i] * std::sin(Phase(x, i));
      }
   }
   void GradU(const Vector &x, DenseMatrix &gradient) const override
   {
      for (int i = 0; i < 3; i++)
      {
         for (int j = 0; j < 3; j++)
         {
            gradient(i, j) = amplitude[i] * a[j] * std::cos(Phase(x, i));
         }
      }
   }
   void LaplaceU(const Vector &x, Vector &value) const override
   {
      U(x, value);
      value *= -(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]);
   }
   void GradDivU(const Vector &x, Vector &value) const override
   {
      value = 0.0;
      for (int i = 0; i < 3; i++)
      {
         for (int j = 0; j < 3; j++)
         {
            value[j] -= amplitude[i] * a[i] * a[j] * std::sin(Phase(x, i));
         }
      }
   }
   real_t P(const Vector &x) const override
   {
      return pressure * std::cos(b[0] * x[0] + b[1] * x[1] + b[2] * x[2]);
   }
   void GradP(const Vector &x, Vector &value) const override
   {
      const real_t s = std::sin(b[0] * x[0] + b[1] * x[1] + b[2] * x[2]);
      for (int i = 0; i < 3; i++)
      {
         value[i] = -pressure * b[i] * s;
      }
   }
   real_t LaplaceP(const Vector &x) const override
   {
      return -(b[0] * b[0] + b[1] * b[1] + b[2] * b[2]) * P(x);
   }

private:
   using Triple = std::array<real_t, 3>;
   real_t Phase(const Vector &x, int i) const
   {
      return a[0] * x[0] + a[1] * x[1] + a[2] * x[2] + i;
   }

   const Triple amplitude{{0.5, -0.4, 0.6}};
   const Triple a{{2.0, 1.5, -1.0}};
   const Triple b{{1.2, -1.6, 2.0}};
   const real_t pressure = 0.7;
};

/// Quadratic U with a divergence that varies, linear P.
class Polynomials : public Shapes
{
public:
   void U(const Vector &x, Vector &value) const override
   {
      value[0] = x[0] * x[0] + x[1] * x[2];
      value[1] = x[0] * x[1] - 0.5 * x[2] * x[2];
      value[2] = x[1] * x[1] + 2.0 * x[0] * x[2];
   }
   void GradU(const Vector &x, DenseMatrix &gradient) const override
   {
      gradient(0, 0) = 2.0 * x[0];
      gradient(0, 1) = x[2];
      gradient(0, 2) = x[1];
      gradient(1, 0) = x[1];
      gradient(1, 1) = x[0];
      gradient(1, 2) = -x[2];
      gradient(2, 0) = 2.0 * x[2];
      gradient(2, 1) = 2.0 * x[1];
      gradient(2, 2) = 2.0 * x[0];
   }
   void LaplaceU(const Vector &, Vector &value) const override
   {
      value[0] = 2.0;
      value[1] = -1.0;
      value[2] = 2.0;
   }
   void GradDivU(const Vector &, Vector &value) const override
   {
      value = 0.0;
      value[0] = 5.0;
   }
   real_t P(const Vector &x) const override
   {
      return 1.0 + x[0] - 2.0 * x[1] + 0.5 * x[2];
   }
   void GradP(const Vector &, Vector &value) const override
   {
      value[0] = 1.0;
      value[1] = -2.0;
      value[2] = 0.5;
   }
   real_t LaplaceP(const Vector &) const override { return 0.0; }
};

using Function = std::function<real_t(real_t)>;

/// Factors in time of the solution; both vanish at t = 0.
struct Factors
{
   Function f;
   Function df;
   Function g;
};

Factors Linear()
{
   const auto t = [](real_t s) { return s; };
   return {t, [](real_t) { return 1.0; }, t};
}

Factors Curved()
{
   return {[](real_t t) { return std::sin(2.0 * t); },
           [](real_t t) { return 2.0 * std::cos(2.0 * t); },
           [](real_t t) { return 1.0 - std::cos(3.0 * t); }};
}

/// Where displacement is prescribed.
enum class Sides
{
   all,
   four
};

/// A problem whose solution is known.
class Manufactured
{
public:
   Manufactured(const Shapes &shapes_, const Factors &factors_,
                Element::Type type, int cells, int order, real_t kappa_,
                Sides sides)
      : shapes(shapes_), factors(factors_), kappa(kappa_),
        mesh(MakeMesh(type, cells)), solid(young, poisson),
        permeability(kappa_), problem(mesh, {order}),
        displacement(3, [this](const Vector &x, real_t t, Vector &value)
                     { EvalU(x, t, value); }),
        pressure([this](const Vector &x, real_t t)
                 { return factors.g(t) * shapes.P(x); }),
        body_force(3, [this](const Vector &x, real_t t, Vector &value)
                   { EvalForce(x, t, value); }),
        source([this](const Vector &x, real_t t) { return EvalSource(x, t); })
   {
      problem.SetMaterial("body", solid, permeability);
      NonlinearOptions options;
      options.linear.relative_tolerance = 1e-11;
      problem.SetNonlinearOptions(options);
      BoundaryConditions &conditions = problem.Conditions();
      conditions.AddBodyForce(body_force);
      conditions.AddFluidSource(source);
      const bool mixed = sides == Sides::four;
      conditions.PrescribeDisplacement(mixed ? Array<int>({1, 2, 4, 5})
                                             : Array<int>({1, 2, 3, 4, 5, 6}),
                                       displacement);
      conditions.PrescribePressure(Array<int>({1, 3}), pressure);
      // Sides by attribute: z0, y0, x1, y1, x0, z1.
      const int axis[6] = {2, 1, 0, 1, 0, 2};
      const real_t sign[6] = {-1.0, -1.0, 1.0, 1.0, -1.0, 1.0};
      for (const int side : mixed ? Array<int>({3, 6}) : Array<int>())
      {
         tractions.push_back(std::make_unique<VectorFunctionCoefficient>(
            3, [this, d = axis[side - 1],
                s = sign[side - 1]](const Vector &x, real_t t, Vector &value)
            { EvalTraction(x, t, d, s, value); }));
         conditions.AddTraction(Array<int>({side}), *tractions.back());
      }
      for (const int side : {2, 4, 5, 6})
      {
         fluxes.push_back(std::make_unique<FunctionCoefficient>(
            [this, d = axis[side - 1], s = sign[side - 1]](const Vector &x,
                                                           real_t t)
            {
               Vector gradient(3);
               shapes.GradP(x, gradient);
               return -kappa * factors.g(t) * s * gradient[d];
            }));
         conditions.AddNormalFlux(Array<int>({side}), *fluxes.back());
      }
   }

   struct Errors
   {
      real_t u;
      real_t p;
   };

   /// Errors in L2 at time @a end after a number of steps.
   Errors Solve(ODESolver &solver, real_t end, int steps)
   {
      March march(problem);
      for (int i = 0; i < steps; i++)
      {
         REQUIRE(march.Step(solver, end / steps));
      }
      displacement.SetTime(end);
      pressure.SetTime(end);
      const IntegrationRule *rules[Geometry::NumGeom];
      for (int g = 0; g < Geometry::NumGeom; g++)
      {
         rules[g] = &IntRules.Get(g, 2 * problem.Spaces().Order() + 3);
      }
      return {march.Displacement().ComputeL2Error(displacement, rules),
              march.Pressure().ComputeL2Error(pressure, rules)};
   }

private:
   /// The unit cube in elements that are skewed smoothly, so that refinement
   /// makes them neither parallel to the axes nor more skewed.
   static NamedMesh MakeMesh(Element::Type type, int cells)
   {
      Mesh mesh = Mesh::MakeCartesian3D(cells, cells, cells, type);
      for (int i = 0; i < mesh.GetNV(); i++)
      {
         real_t *x = mesh.GetVertex(i);
         const real_t bump = 8.0 * x[0] * (1.0 - x[0]) * x[1] * (1.0 - x[1]) *
                             x[2] * (1.0 - x[2]);
         x[0] += 0.2 * bump;
         x[1] -= 0.15 * bump;
         x[2] += 0.25 * bump;
      }
      return DistributeMesh(mesh, {{"body", {1}}}, {}, MPI_COMM_WORLD);
   }

   void EvalU(const Vector &x, real_t t, Vector &value) const
   {
      shapes.U(x, value);
      value *= factors.f(t);
   }
   void EvalForce(const Vector &x, real_t t, Vector &value) const
   {
      Vector laplace(3);
      Vector grad_div(3);
      shapes.LaplaceU(x, laplace);
      shapes.GradDivU(x, grad_div);
      shapes.GradP(x, value);
      value *= factors.g(t);
      value.Add(-mu * factors.f(t), laplace);
      value.Add(-(lambda + mu) * factors.f(t), grad_div);
   }
   real_t EvalSource(const Vector &x, real_t t) const
   {
      DenseMatrix gradient(3);
      shapes.GradU(x, gradient);
      return factors.df(t) * gradient.Trace() -
             kappa * factors.g(t) * shapes.LaplaceP(x);
   }
   void EvalTraction(const Vector &x, real_t t, int d, real_t sign,
                     Vector &value) const
   {
      DenseMatrix gradient(3);
      shapes.GradU(x, gradient);
      for (int i = 0; i < 3; i++)
      {
         value[i] =
            sign * factors.f(t) * mu * (gradient(i, d) + gradient(d, i));
      }
      value[d] += sign * (factors.f(t) * lambda * gradient.Trace() -
                          factors.g(t) * shapes.P(x));
   }

   const Shapes &shapes;
   Factors factors;
   real_t kappa;
   NamedMesh mesh;
   IsotropicElastic solid;
   ConstantPermeability permeability;
   BiphasicProblem problem;
   VectorFunctionCoefficient displacement;
   FunctionCoefficient pressure;
   VectorFunctionCoefficient body_force;
   FunctionCoefficient source;
   std::vector<std::unique_ptr<VectorCoefficient>> tractions;
   std::vector<std::unique_ptr<Coefficient>> fluxes;
};

constexpr real_t slack = 0.15;

// Flow through an element during the step is much, or nothing, against what its
// volume can take up.
constexpr real_t drained = 10.0;
constexpr real_t undrained = 1e-6;

/// Convergence in space from @a cells to twice as many cells on an edge.
Manufactured::Errors RateInSpace(Element::Type type, int cells, int order,
                                 real_t kappa, Sides sides)
{
   const Waves waves;
   BackwardEulerSolver solver;
   const Manufactured::Errors coarse =
      Manufactured(waves, Linear(), type, cells, order, kappa, sides)
         .Solve(solver, 1.0, 1);
   const Manufactured::Errors fine =
      Manufactured(waves, Linear(), type, 2 * cells, order, kappa, sides)
         .Solve(solver, 1.0, 1);
   CAPTURE(coarse.u, fine.u, coarse.p, fine.p);
   // The solution is of the order of one: these are small.
   CHECK(fine.u < 0.02);
   CHECK(fine.p < 0.1);
   return {std::log2(coarse.u / fine.u), std::log2(coarse.p / fine.p)};
}
} // namespace

TEST_CASE("Quadratic displacement converges with orders 3 and 2 undrained, 2 "
          "and 2 drained")
{
   const auto type =
      GENERATE(Element::TETRAHEDRON, Element::HEXAHEDRON, Element::WEDGE);
   CAPTURE(static_cast<int>(type));
   const Manufactured::Errors stokes =
      RateInSpace(type, 4, 2, undrained, Sides::all);
   CAPTURE(stokes.u, stokes.p);
   CHECK(stokes.u > 3.0 - slack);
   CHECK(stokes.p > 2.0 - slack);
   const Manufactured::Errors poisson_like =
      RateInSpace(type, 4, 2, drained, Sides::four);
   CAPTURE(poisson_like.u, poisson_like.p);
   CHECK(poisson_like.u > 2.0 - slack);
   CHECK(poisson_like.p > 2.0 - slack);
}

TEST_CASE("Cubic displacement converges with orders 4 and 3")
{
   const auto type = GENERATE(Element::TETRAHEDRON, Element::HEXAHEDRON);
   const real_t kappa = GENERATE(undrained, drained);
   CAPTURE(static_cast<int>(type), kappa);
   const Manufactured::Errors rate =
      RateInSpace(type, 2, 3, kappa, Sides::four);
   CAPTURE(rate.u, rate.p);
   CHECK(rate.u > 4.0 - slack);
   CHECK(rate.p > 3.0 - slack);
}

TEST_CASE("Stabilized linear displacement converges with orders 2 and 1")
{
   const auto type =
      GENERATE(Element::TETRAHEDRON, Element::HEXAHEDRON, Element::WEDGE);
   const real_t kappa = GENERATE(undrained, drained);
   CAPTURE(static_cast<int>(type), kappa);
   const Manufactured::Errors rate =
      RateInSpace(type, 6, 1, kappa, Sides::four);
   CAPTURE(rate.u, rate.p);
   CHECK(rate.u > 2.0 - slack);
   CHECK(rate.p > 1.0 - slack);
}

TEST_CASE("Time schemes have their orders in displacement and pressure")
{
   struct Scheme
   {
      std::unique_ptr<ODESolver> solver;
      real_t order;
   };
   std::vector<Scheme> schemes;
   schemes.push_back({std::make_unique<BackwardEulerSolver>(), 1.0});
   schemes.push_back({std::make_unique<Sdirk2Solver>(), 2.0});
   schemes.push_back({std::make_unique<SDIRK33Solver>(), 3.0});
   const Polynomials polynomials;
   Manufactured problem(polynomials, Curved(), Element::TETRAHEDRON, 2, 2, 1e-3,
                        Sides::four);
   for (const Scheme &scheme : schemes)
   {
      const int steps = 16;
      const Manufactured::Errors coarse =
         problem.Solve(*scheme.solver, 1.0, steps);
      const Manufactured::Errors fine =
         problem.Solve(*scheme.solver, 1.0, 2 * steps);
      const real_t u_rate = std::log2(coarse.u / fine.u);
      const real_t p_rate = std::log2(coarse.p / fine.p);
      CAPTURE(scheme.order, coarse.u, fine.u, coarse.p, fine.p);
      CHECK(u_rate > scheme.order - slack);
      CHECK(p_rate > scheme.order - slack);
   }
}
