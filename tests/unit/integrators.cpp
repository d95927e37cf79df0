// ranks: 1

#include "synovia/fem/effective_stress_integrator.hpp"
#include "synovia/fem/pressure_projection_integrator.hpp"
#include "synovia/general/symmetric_eigenvalues.hpp"
#include "synovia/materials/permeabilities/constant_permeability.hpp"
#include "synovia/materials/solids/isotropic_elastic.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>

using namespace mfem;
using namespace synovia;

namespace
{
constexpr real_t young = 0.7;
constexpr real_t poisson = 0.2;
constexpr real_t mu = young / (2.0 * (1.0 + poisson));
constexpr real_t lambda =
   young * poisson / ((1.0 + poisson) * (1.0 - 2.0 * poisson));

/// One material for the attribute 1.
struct OneMaterial
{
   explicit OneMaterial(real_t scale = 1.0)
      : solid(scale * young, poisson), permeability(1.0)
   {
      table.Set(Array<int>({1}), {&solid, &permeability, 0.2});
   }
   IsotropicElastic solid;
   ConstantPermeability permeability;
   MaterialTable table;
};

/// A distorted box of a few elements, curved if @a order is 2.
Mesh MakeMesh(Element::Type type, int order, real_t size = 1.0)
{
   Mesh mesh = Mesh::MakeCartesian3D(2, 1, 1, type, size, size, size);
   if (order > 1)
   {
      mesh.SetCurvature(order);
   }
   mesh.Transform(
      [size](const Vector &from, Vector &to)
      {
         const real_t x = from[0] / size;
         const real_t y = from[1] / size;
         const real_t z = from[2] / size;
         to.SetSize(3);
         to[0] = size * (x + 0.2 * y * z - 0.1 * y * y);
         to[1] = size * (y + 0.15 * x * x);
         to[2] = size * (1.2 * z - 0.2 * x * y + 0.1 * y);
      });
   return mesh;
}

/// The matrix of an integrator on an element.
DenseMatrix ElementMatrix(BilinearFormIntegrator &integrator, Mesh &mesh, int i,
                          const FiniteElement &el)
{
   DenseMatrix matrix;
   integrator.AssembleElementMatrix(el, *mesh.GetElementTransformation(i),
                                    matrix);
   return matrix;
}

real_t Difference(const DenseMatrix &a, const DenseMatrix &b)
{
   DenseMatrix difference(a);
   difference -= b;
   return difference.MaxMaxNorm();
}
} // namespace

TEST_CASE("The effective stress matrix is that of MFEM's elasticity")
{
   const auto type =
      GENERATE(Element::TETRAHEDRON, Element::HEXAHEDRON, Element::WEDGE);
   const int curvature = GENERATE(1, 2);
   const int order = GENERATE(1, 2, 3);
   CAPTURE(static_cast<int>(type), curvature, order);
   Mesh mesh = MakeMesh(type, curvature);
   const H1_FECollection elements(order, 3);
   FiniteElementSpace space(&mesh, &elements);
   const OneMaterial material;
   ConstantCoefficient lambda_coefficient(lambda);
   ConstantCoefficient mu_coefficient(mu);
   EffectiveStressIntegrator ours(material.table);
   ElasticityIntegrator theirs(lambda_coefficient, mu_coefficient);
   for (int i = 0; i < mesh.GetNE(); i++)
   {
      const FiniteElement &el = *space.GetFE(i);
      // With the same quadrature they are the same, whether or not it is exact.
      const IntegrationRule &rule =
         IntRules.Get(el.GetGeomType(), 2 * order + 2);
      ours.SetIntRule(&rule);
      theirs.SetIntRule(&rule);
      const DenseMatrix a = ElementMatrix(ours, mesh, i, el);
      const DenseMatrix b = ElementMatrix(theirs, mesh, i, el);
      REQUIRE(a.Height() == 3 * el.GetDof());
      CHECK(Difference(a, b) < 1e-13 * b.MaxMaxNorm());
   }
}

TEST_CASE("The effective stress integrator integrates exactly what can be")
{
   const auto type =
      GENERATE(Element::TETRAHEDRON, Element::HEXAHEDRON, Element::WEDGE);
   const int order = GENERATE(1, 2, 3);
   CAPTURE(static_cast<int>(type), order);
   // On straight elements the integrand is a polynomial.
   Mesh mesh = Mesh::MakeCartesian3D(1, 1, 1, type, 1.0, 2.0, 0.5);
   const H1_FECollection elements(order, 3);
   FiniteElementSpace space(&mesh, &elements);
   const OneMaterial material;
   EffectiveStressIntegrator integrator(material.table);
   for (int i = 0; i < mesh.GetNE(); i++)
   {
      const FiniteElement &el = *space.GetFE(i);
      integrator.SetIntRule(nullptr);
      const DenseMatrix chosen = ElementMatrix(integrator, mesh, i, el);
      integrator.SetIntRule(&IntRules.Get(el.GetGeomType(), 2 * order + 4));
      const DenseMatrix exact = ElementMatrix(integrator, mesh, i, el);
      CHECK(Difference(chosen, exact) < 1e-12 * exact.MaxMaxNorm());
   }
}

TEST_CASE("Rigid motions have no effective stress, curved elements included")
{
   const auto type =
      GENERATE(Element::TETRAHEDRON, Element::HEXAHEDRON, Element::WEDGE);
   const int curvature = GENERATE(1, 2);
   CAPTURE(static_cast<int>(type), curvature);
   Mesh mesh = MakeMesh(type, curvature);
   // Isoparametric, so that it has the rotations.
   const H1_FECollection elements(2, 3);
   FiniteElementSpace space(&mesh, &elements, 3);
   const OneMaterial material;
   BilinearForm form(&space);
   form.AddDomainIntegrator(new EffectiveStressIntegrator(material.table));
   form.Assemble();
   form.Finalize();
   const real_t size = form.SpMat().MaxNorm();
   for (int motion = 0; motion < 6; motion++)
   {
      VectorFunctionCoefficient coefficient(3,
                                            [motion](const Vector &x, Vector &u)
                                            {
                                               u = 0.0;
                                               const int a = motion % 3;
                                               if (motion < 3)
                                               {
                                                  u[a] = 1.0;
                                               }
                                               else
                                               {
                                                  u[(a + 1) % 3] =
                                                     x[(a + 2) % 3];
                                                  u[(a + 2) % 3] =
                                                     -x[(a + 1) % 3];
                                               }
                                            });
      GridFunction u(&space);
      u.ProjectCoefficient(coefficient);
      Vector force(u.Size());
      form.SpMat().Mult(u, force);
      CAPTURE(motion);
      CHECK(force.Normlinf() < 1e-12 * size);
   }
}

TEST_CASE("The pressure projection is symmetric and semi-definite, and its "
          "kernel are the constants")
{
   const auto type = GENERATE(Element::TETRAHEDRON, Element::HEXAHEDRON,
                              Element::WEDGE, Element::PYRAMID);
   const int curvature = GENERATE(1, 2);
   CAPTURE(static_cast<int>(type), curvature);
   Mesh mesh = MakeMesh(type, curvature);
   const H1_FECollection elements(1, 3);
   FiniteElementSpace space(&mesh, &elements);
   const OneMaterial material;
   PressureProjectionIntegrator integrator(material.table);
   for (int i = 0; i < mesh.GetNE(); i++)
   {
      const FiniteElement &el = *space.GetFE(i);
      DenseMatrix matrix = ElementMatrix(integrator, mesh, i, el);
      const int dofs = el.GetDof();
      REQUIRE(matrix.Height() == dofs);
      const real_t size = matrix.MaxMaxNorm();
      DenseMatrix transpose(matrix);
      transpose.Transpose();
      CHECK(Difference(matrix, transpose) < 1e-14 * size);

      Vector constant(dofs);
      Vector product(dofs);
      constant = 1.0;
      matrix.Mult(constant, product);
      CHECK(product.Normlinf() < 1e-14 * size);

      const Vector eigenvalues = SymmetricEigenvalues(matrix);
      CHECK(std::abs(eigenvalues[0]) < 1e-14 * size);
      // Of the order of those of a mass matrix: far from the kernel.
      CHECK(eigenvalues[1] > 1e-3 * size);
   }
}

TEST_CASE("The pressure projection measures the variation within an element")
{
   // For p = x on the unit cube the square of p - 1/2 has the integral 1/12.
   Mesh mesh = Mesh::MakeCartesian3D(1, 1, 1, Element::HEXAHEDRON);
   const H1_FECollection elements(1, 3);
   FiniteElementSpace space(&mesh, &elements);
   // The factor is max(1/(2 mu), 3/H_A): either may be the larger one.
   const real_t ratio = GENERATE(0.2, 0.45);
   const IsotropicElastic solid(young, ratio);
   const ConstantPermeability permeability(1.0);
   MaterialTable table;
   table.Set(Array<int>({1}), {&solid, &permeability, 0.2});
   PressureProjectionIntegrator integrator(table);
   DenseMatrix matrix = ElementMatrix(integrator, mesh, 0, *space.GetFE(0));
   GridFunction p(&space);
   FunctionCoefficient x([](const Vector &at) { return at[0]; });
   p.ProjectCoefficient(x);
   Vector values;
   Array<int> dofs;
   space.GetElementDofs(0, dofs);
   p.GetSubVector(dofs, values);
   const real_t factor =
      std::max(0.5 / solid.ShearModulus(), 3.0 / solid.AggregateModulus());
   CHECK(matrix.InnerProduct(values, values) == Approx(factor / 12.0));
}

TEST_CASE("The pressure projection scales with volume / stiffness")
{
   const auto type =
      GENERATE(Element::TETRAHEDRON, Element::HEXAHEDRON, Element::WEDGE);
   Mesh mesh = MakeMesh(type, 1);
   Mesh large = MakeMesh(type, 1, 10.0);
   const H1_FECollection elements(1, 3);
   FiniteElementSpace space(&mesh, &elements);
   const FiniteElement &el = *space.GetFE(0);
   const OneMaterial material;
   const OneMaterial stiff(4.0);
   PressureProjectionIntegrator integrator(material.table);
   PressureProjectionIntegrator stiff_integrator(stiff.table);
   const DenseMatrix reference = ElementMatrix(integrator, mesh, 0, el);
   DenseMatrix larger = ElementMatrix(integrator, large, 0, el);
   larger *= 1e-3;
   CHECK(Difference(larger, reference) < 1e-13 * reference.MaxMaxNorm());
   DenseMatrix stiffer = ElementMatrix(stiff_integrator, mesh, 0, el);
   stiffer *= 4.0;
   CHECK(Difference(stiffer, reference) < 1e-13 * reference.MaxMaxNorm());
}
