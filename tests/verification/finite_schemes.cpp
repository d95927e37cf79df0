// ranks: 1 2 3
//
// Time schemes have their orders in finite deformation, where the volume ratio
// J is what they conserve: a block glued between plates is compressed by 30 %
// and sheared in a smooth course of time, drained on one side. The mesh is the
// same throughout, and the reference has two to four times as many steps as
// the finer run, of the scheme of order 3. The permeability is low for the same
// reason as in manufactured.cpp: what is prescribed depends on time.

#include "support/boxes.hpp"
#include "synovia/general/reduce.hpp"
#include "synovia/materials/permeabilities/holmes_mow_permeability.hpp"
#include "synovia/materials/solids/holmes_mow.hpp"
#include "synovia/synovia.hpp"

#include <catch2/catch.hpp>

#include <cmath>

using namespace mfem;
using namespace synovia;

namespace
{
constexpr real_t end = 100.0;

Vector Solve(TimeScheme scheme, int steps)
{
   BoxOptions box;
   box.nx = box.ny = 1;
   box.nz = 3;
   NamedMesh mesh = MakeBox(box);
   SpaceOptions space;
   space.order = 2;
   space.deformation = Deformation::finite;
   BiphasicProblem problem(mesh, space);
   const HolmesMow solid(0.5, 0.1, 0.5);
   const HolmesMowPermeability permeability(1.0e-3, 2.0, 2.0, 0.2);
   problem.SetMaterial("body", solid, permeability);
   problem.FixDisplacement("z0");
   problem.PrescribePressure("x1", 0.0);
   // At rest in the beginning.
   VectorFunctionCoefficient plate(3,
                                   [](const Vector &, real_t t, Vector &u)
                                   {
                                      u = 0.0;
                                      u[0] = 0.1 * std::pow(t / end, 2);
                                      u[2] = -0.15 *
                                             (1.0 - std::cos(M_PI * t / end));
                                   });
   problem.Conditions().PrescribeDisplacement(mesh.Boundary("z1"), plate);
   NonlinearOptions nonlinear;
   nonlinear.linear.relative_tolerance = 1e-11;
   problem.SetNonlinearOptions(nonlinear);
   TimeOptions times;
   times.end = end;
   times.step = end / steps;
   times.scheme = scheme;
   TimeStepper stepper(problem, times);
   while (!stepper.Done())
   {
      const StepReport report = stepper.Step();
      INFO(report.reason);
      REQUIRE(report.converged);
   }
   return stepper.State();
}

struct Errors
{
   real_t u;
   real_t p;
};

// Relative, in the norm of the dofs.
Errors Compare(const Vector &found, const Vector &reference, int u_size)
{
   real_t sums[4] = {0.0, 0.0, 0.0, 0.0};
   for (int i = 0; i < found.Size(); i++)
   {
      const int block = i < u_size ? 0 : 1;
      sums[block] += std::pow(found[i] - reference[i], 2);
      sums[2 + block] += std::pow(reference[i], 2);
   }
   MPI_Allreduce(MPI_IN_PLACE, sums, 4, MPITypeMap<real_t>::mpi_type, MPI_SUM,
                 MPI_COMM_WORLD);
   return {std::sqrt(sums[0] / sums[2]), std::sqrt(sums[1] / sums[3])};
}
} // namespace

TEST_CASE("Time schemes have their orders in finite deformation")
{
   const Vector reference = Solve(TimeScheme::sdirk33, 128);
   BoxOptions box;
   box.nx = box.ny = 1;
   box.nz = 3;
   NamedMesh mesh = MakeBox(box);
   const int u_size =
      BiphasicSpaces(mesh.Get(), 2).Displacement().GetTrueVSize();
   struct Scheme
   {
      TimeScheme scheme;
      real_t order;
      int steps;
   };
   const Scheme schemes[] = {{TimeScheme::backward_euler, 1.0, 16},
                             {TimeScheme::sdirk23, 2.0, 32},
                             {TimeScheme::sdirk33, 3.0, 16}};
   constexpr real_t slack = 0.2;
   for (const Scheme &scheme : schemes)
   {
      const Errors coarse =
         Compare(Solve(scheme.scheme, scheme.steps), reference, u_size);
      const Errors fine =
         Compare(Solve(scheme.scheme, 2 * scheme.steps), reference, u_size);
      const real_t u_rate = std::log2(coarse.u / fine.u);
      const real_t p_rate = std::log2(coarse.p / fine.p);
      CAPTURE(scheme.order, coarse.u, fine.u, coarse.p, fine.p, u_rate, p_rate);
      CHECK(u_rate > scheme.order - slack);
      CHECK(p_rate > scheme.order - slack);
   }
}
