// ranks: 1 2
//
// The paper's meniscus, constant by constant, in frames of both kinds.

#include "support/boxes.hpp"
#include "support/meniscus_fibers.hpp"
#include "synovia/materials/stiffness_range.hpp"
#include "synovia/synovia.hpp"

#include <catch2/catch.hpp>

#include <cmath>

using namespace mfem;
using namespace synovia;

namespace
{
/// A point of a unit cube.
class PointAt
{
public:
   explicit PointAt(const Vector &x)
   {
      trans.SetIdentityTransformation(Geometry::CUBE);
      ip.Set3(x[0], x[1], x[2]);
      trans.SetIntPoint(&ip);
   }
   MaterialPoint Get() { return {trans, ip}; }

private:
   IsoparametricTransformation trans;
   IntegrationPoint ip;
};

DenseMatrix StiffnessAt(const MaterialFrame &frame, const Vector &x)
{
   PointAt point(x);
   DenseMatrix stiffness;
   TransverselyIsotropic(MeniscusFibers(), frame)
      .GetStiffness(point.Get().trans, point.Get().ip, stiffness);
   return stiffness;
}

DenseMatrix AxesAt(const MaterialFrame &frame, const Vector &x)
{
   const Tensor3<> axes = frame.GetAxes(PointAt(x).Get());
   DenseMatrix matrix(3);
   for (int k = 0; k < 9; k++)
   {
      matrix(k / 3, k % 3) = axes[k / 3][k % 3];
   }
   return matrix;
}

/// Stress of a strain in the axes, from the stiffness in space.
DenseMatrix StressInAxes(const DenseMatrix &stiffness, const DenseMatrix &axes,
                         const DenseMatrix &strain_in_axes)
{
   DenseMatrix strain(3);
   DenseMatrix half(3);
   Mult(axes, strain_in_axes, half);
   MultABt(half, axes, strain);
   Vector voigt({strain(0, 0), strain(1, 1), strain(2, 2), 2 * strain(0, 1),
                 2 * strain(1, 2), 2 * strain(0, 2)});
   Vector s(6);
   stiffness.Mult(voigt, s);
   DenseMatrix stress(3);
   stress(0, 0) = s[0];
   stress(1, 1) = s[1];
   stress(2, 2) = s[2];
   stress(0, 1) = stress(1, 0) = s[3];
   stress(1, 2) = stress(2, 1) = s[4];
   stress(0, 2) = stress(2, 0) = s[5];
   DenseMatrix in_axes(3);
   MultAtB(axes, stress, half);
   Mult(half, axes, in_axes);
   return in_axes;
}

void CheckConstants(const MaterialFrame &frame, const Vector &x)
{
   const FiberConstants c = MeniscusFibers();
   const DenseMatrix stiffness = StiffnessAt(frame, x);
   const DenseMatrix axes = AxesAt(frame, x);
   CHECK(axes.Det() == Approx(1.0));
   // Strains of a unit stress along r, theta, z.
   const real_t contraction[3][3] = {
      {1.0 / c.young_r, -c.poisson_rtheta / c.young_r,
       -c.poisson_rz / c.young_r},
      {-c.poisson_rtheta / c.young_r, 1.0 / c.young_theta,
       -c.poisson_rtheta / c.young_r},
      {-c.poisson_rz / c.young_r, -c.poisson_rtheta / c.young_r,
       1.0 / c.young_r}};
   // nu_thetaz / E_theta = nu_ztheta / E_z, with the paper's nu_thetaz = 2.
   CHECK(2.0 / c.young_theta == Approx(c.poisson_rtheta / c.young_r));
   for (int along = 0; along < 3; along++)
   {
      DenseMatrix strain(3);
      strain = 0.0;
      for (int d = 0; d < 3; d++)
      {
         strain(d, d) = contraction[along][d];
      }
      const DenseMatrix stress = StressInAxes(stiffness, axes, strain);
      for (int i = 0; i < 3; i++)
      {
         for (int j = 0; j < 3; j++)
         {
            CHECK(stress(i, j) ==
                  Approx(i == along && j == along ? 1.0 : 0.0).margin(1e-9));
         }
      }
   }
   const real_t in_plane = c.young_r / (2.0 * (1.0 + c.poisson_rz));
   const real_t shear[3] = {c.shear_rtheta, c.shear_rtheta, in_plane};
   const int pairs[3][2] = {{0, 1}, {1, 2}, {0, 2}};
   for (int p = 0; p < 3; p++)
   {
      DenseMatrix strain(3);
      strain = 0.0;
      strain(pairs[p][0], pairs[p][1]) = strain(pairs[p][1], pairs[p][0]) = 0.5;
      const DenseMatrix stress = StressInAxes(stiffness, axes, strain);
      CHECK(stress(pairs[p][0], pairs[p][1]) == Approx(shear[p]));
   }
}
} // namespace

TEST_CASE("Every constant of a fibrous solid, in both frames")
{
   const Vector x({0.6, 0.3, 0.8});
   SECTION("cartesian, along an axis")
   {
      const CartesianFrame frame({0.0, 2.0, 0.0});
      CheckConstants(frame, x);
   }
   SECTION("cartesian, oblique")
   {
      const CartesianFrame frame({0.3, -0.5, 0.7});
      CheckConstants(frame, x);
   }
   SECTION("cylindrical")
   {
      const CylindricalFrame frame({-1.0, 0.1, 0.0}, {0.0, 0.0, 3.0});
      CheckConstants(frame, x);
      const DenseMatrix axes = AxesAt(frame, x);
      const real_t r = std::hypot(1.6, 0.2);
      CHECK(axes(0, 0) == Approx(1.6 / r));
      CHECK(axes(1, 0) == Approx(0.2 / r));
      CHECK(axes(0, 1) == Approx(-0.2 / r));
      CHECK(axes(1, 1) == Approx(1.6 / r));
      CHECK(axes(2, 2) == Approx(1.0));
   }
   SECTION("cylindrical, oblique")
   {
      const CylindricalFrame frame({-1.0, 0.1, 0.0}, {0.2, -0.4, 1.0});
      CheckConstants(frame, x);
   }
}

TEST_CASE("A fibrous solid that is isotropic")
{
   FiberConstants constants;
   constants.young_r = constants.young_theta = 0.7;
   constants.poisson_rtheta = constants.poisson_rz = 0.3;
   constants.shear_rtheta = 0.7 / 2.6;
   const CartesianFrame frame({1.0, 2.0, 3.0});
   IsoparametricTransformation trans;
   trans.SetIdentityTransformation(Geometry::CUBE);
   IntegrationPoint ip;
   ip.Set3(0.1, 0.2, 0.3);
   DenseMatrix stiffness;
   DenseMatrix isotropic;
   const TransverselyIsotropic law(constants, frame);
   law.GetStiffness(trans, ip, stiffness);
   IsotropicElastic(0.7, 0.3).GetStiffness(trans, ip, isotropic);
   stiffness -= isotropic;
   CHECK(stiffness.MaxMaxNorm() < 1e-13);
   CHECK(law.AggregateModulus() == Approx(isotropic(0, 0)));
   CHECK(law.ShearModulus() == Approx(isotropic(3, 3)));
}

TEST_CASE("Constants that make no sense are refused")
{
   const CartesianFrame frame({0.0, 0.0, 1.0});
   FiberConstants constants = MeniscusFibers();
   constants.young_theta = 0.0;
   CHECK_THROWS_WITH(
      TransverselyIsotropic(constants, frame),
      "Young's modulus along the fibers is 0; it must be positive");
   constants = MeniscusFibers();
   constants.poisson_rz = 0.999;
   CHECK_THROWS_WITH(TransverselyIsotropic(constants, frame),
                     Catch::Contains("not positive definite") &&
                        Catch::Contains("nu_rz = 0.999"));
   constants = MeniscusFibers();
   constants.poisson_rtheta = 0.3;
   CHECK_THROWS_WITH(TransverselyIsotropic(constants, frame),
                     Catch::Contains("not positive definite"));
   CHECK_THROWS_WITH(CartesianFrame({0.0, 0.0, 0.0}),
                     Catch::Contains("is zero"));
   CHECK_THROWS_WITH(CylindricalFrame({1.0, 0.0, 0.0}, {0.0, 0.0, 0.0}),
                     Catch::Contains("is zero"));
}

TEST_CASE("A bar of fibers stretches as its constants say")
{
   // Rollers at three sides, pulled along its fibers.
   BoxOptions box;
   box.nx = box.ny = 2;
   NamedMesh mesh = MakeBox(box);
   const CartesianFrame frame({0.0, 0.0, 1.0});
   const FiberConstants constants = MeniscusFibers();
   const TransverselyIsotropic solid(constants, frame);
   const ConstantPermeability permeability(1.0);
   BiphasicProblem problem(mesh, SpaceOptions());
   problem.SetMaterial("body", solid, permeability);
   problem.PrescribeDisplacement("x0", 0, 0.0);
   problem.PrescribeDisplacement("y0", 1, 0.0);
   problem.PrescribeDisplacement("z0", 2, 0.0);
   problem.AddNormalTraction("z1", 0.01);
   problem.PrescribePressure("z1", 0.0);
   TimeOptions times;
   times.step = times.end = 1e8;
   TimeStepper stepper(problem, times);
   REQUIRE(stepper.Step().converged);
   const Vector &u = stepper.State().GetBlock(0);
   const auto largest = [&](int component)
   {
      real_t value = 0.0;
      for (int i = component; i < u.Size(); i += 3)
      {
         value = std::max(value, std::abs(u[i]));
      }
      MPI_Allreduce(MPI_IN_PLACE, &value, 1, MPITypeMap<real_t>::mpi_type,
                    MPI_MAX, MPI_COMM_WORLD);
      return value;
   };
   CHECK(largest(2) == Approx(0.01 / constants.young_theta).epsilon(1e-5));
   // nu_thetar = nu_rtheta E_theta / E_r
   const real_t across = 0.01 * constants.poisson_rtheta / constants.young_r;
   CHECK(largest(0) == Approx(across).epsilon(1e-5));
   CHECK(largest(1) == Approx(across).epsilon(1e-5));
}

TEST_CASE("The axis of a cylindrical frame must not run through its body")
{
   BoxOptions box;
   box.nx = box.ny = 3;
   NamedMesh mesh = MakeBox(box);
   const ConstantPermeability permeability(1.0);
   const CylindricalFrame inside({0.5, 0.45, 0.0}, {0.0, 0.0, 1.0});
   const CylindricalFrame on_an_edge({0.0, 0.0, 0.0}, {0.0, 0.0, 1.0});
   for (const CylindricalFrame *frame : {&inside, &on_an_edge})
   {
      const TransverselyIsotropic solid(MeniscusFibers(), *frame);
      BiphasicProblem problem(mesh, SpaceOptions());
      problem.SetMaterial("body", solid, permeability);
      CHECK_THROWS_WITH(problem.Operator(),
                        Catch::Contains("axis of its cylindrical frame"));
   }
   const CylindricalFrame outside({-0.2, -0.2, 0.0}, {0.0, 0.0, 1.0});
   const TransverselyIsotropic solid(MeniscusFibers(), outside);
   BiphasicProblem problem(mesh, SpaceOptions());
   problem.SetMaterial("body", solid, permeability);
   CHECK_NOTHROW(problem.VerifyMaterials());
   ElementTransformation &trans = *mesh.Get().GetElementTransformation(0);
   const StiffnessRange range = RangeOfStiffness(solid, trans);
   CHECK(range.least > 0.0);
   CHECK(range.largest > 100.0);
}
