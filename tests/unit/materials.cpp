// ranks: 1

#include "synovia/general/error.hpp"
#include "synovia/general/symmetric_eigenvalues.hpp"
#include "synovia/materials/material_table.hpp"
#include "synovia/materials/permeabilities/constant_permeability.hpp"
#include "synovia/materials/solids/isotropic_elastic.hpp"

#include <catch2/catch.hpp>

#include <limits>

using namespace mfem;
using namespace synovia;

namespace
{
const real_t not_a_number = std::numeric_limits<real_t>::quiet_NaN();

DenseMatrix Stiffness(const SolidLaw &law)
{
   IsoparametricTransformation trans;
   DenseMatrix stiffness;
   law.GetStiffness(trans, IntegrationPoint(), stiffness);
   return stiffness;
}
} // namespace

TEST_CASE("Uniaxial and confined stretch of an isotropic solid")
{
   const real_t young = 0.5417;
   const real_t poisson = 0.2;
   const IsotropicElastic law(young, poisson);
   const DenseMatrix stiffness = Stiffness(law);
   REQUIRE(stiffness.Height() == 6);
   REQUIRE(stiffness.Width() == 6);

   // The strain of uniaxial stress gives that stress.
   Vector strain(6);
   Vector stress(6);
   strain = 0.0;
   strain[0] = -poisson;
   strain[1] = 1.0;
   strain[2] = -poisson;
   stiffness.Mult(strain, stress);
   for (int i = 0; i < 6; i++)
   {
      CHECK(stress[i] == Approx(i == 1 ? young : 0.0).margin(1e-15));
   }

   // The strain of confined compression has H_A, engineering shear has mu.
   CHECK(law.AggregateModulus() ==
         Approx(young * (1.0 - poisson) /
                ((1.0 + poisson) * (1.0 - 2.0 * poisson))));
   CHECK(law.ShearModulus() == Approx(young / (2.0 * (1.0 + poisson))));
   for (int i = 0; i < 3; i++)
   {
      CHECK(stiffness(i, i) == Approx(law.AggregateModulus()));
      CHECK(stiffness(i + 3, i + 3) == Approx(law.ShearModulus()));
   }
   for (int i = 0; i < 6; i++)
   {
      for (int j = 0; j < 6; j++)
      {
         CHECK(stiffness(i, j) == stiffness(j, i));
         if (i != j && (i > 2 || j > 2))
         {
            CHECK(stiffness(i, j) == 0.0);
         }
      }
   }
}

TEST_CASE("An isotropic solid may be auxetic or nearly incompressible")
{
   for (const real_t poisson : {-0.9, 0.0, 0.4999})
   {
      const Vector eigenvalues =
         SymmetricEigenvalues(Stiffness(IsotropicElastic(1.0, poisson)));
      CAPTURE(poisson);
      CHECK(eigenvalues.Min() > 0.0);
   }
}

TEST_CASE("Moduli that make no sense are refused")
{
   CHECK_THROWS_WITH(IsotropicElastic(0.0, 0.3),
                     "Young's modulus is 0; it must be positive");
   CHECK_THROWS_WITH(IsotropicElastic(-2.5, 0.3),
                     "Young's modulus is -2.5; it must be positive");
   CHECK_THROWS_AS(IsotropicElastic(not_a_number, 0.3), Error);
   for (const real_t poisson : {0.5, 0.7, -1.0, not_a_number})
   {
      CHECK_THROWS_AS(IsotropicElastic(1.0, poisson), Error);
   }
   CHECK_THROWS_WITH(IsotropicElastic(1.0, 0.5),
                     "Poisson's ratio is 0.5; it must be between -1 and 0.5");
}

TEST_CASE("Permeabilities that make no sense are refused")
{
   CHECK(ConstantPermeability(4.0e-3).ReferenceValue() == 4.0e-3);
   CHECK_THROWS_WITH(ConstantPermeability(0.0),
                     "the permeability is 0; it must be positive");
   CHECK_THROWS_WITH(ConstantPermeability(-4.0e-3),
                     "the permeability is -0.004; it must be positive");
   CHECK_THROWS_AS(ConstantPermeability(not_a_number), Error);
}

TEST_CASE("A material table knows the material of each attribute")
{
   const IsotropicElastic soft(1.0, 0.1);
   const IsotropicElastic stiff(10.0, 0.1);
   const ConstantPermeability permeability(1.0);
   MaterialTable table;
   CHECK_FALSE(table.Has(1));
   table.Set(Array<int>({1, 5}), {&soft, &permeability, 0.2});
   CHECK(table.Has(1));
   CHECK(table.Has(5));
   for (const int attribute : {-1, 0, 2, 4, 6})
   {
      CHECK_FALSE(table.Has(attribute));
   }
   CHECK(table.Get(5).solid == &soft);
   table.Set(Array<int>({5}), {&stiff, &permeability, 0.3});
   CHECK(table.Get(1).solid == &soft);
   CHECK(table.Get(5).solid == &stiff);
   CHECK(table.Get(5).solid_fraction == 0.3);

   IsoparametricTransformation trans;
   trans.Attribute = 5;
   const IntegrationPoint ip{};
   CHECK(PermeabilityCoefficient(table).Eval(trans, ip) == 1.0);
   CHECK(ComplianceCoefficient(table).Eval(trans, ip) ==
         Approx(1.0 / stiff.AggregateModulus()));
}

TEST_CASE("Solid fractions that make no sense are refused")
{
   const IsotropicElastic solid(1.0, 0.1);
   const ConstantPermeability permeability(1.0);
   MaterialTable table;
   for (const real_t fraction : {-0.1, 0.0, 1.0, 1.5, not_a_number})
   {
      CAPTURE(fraction);
      CHECK_THROWS_AS(
         table.Set(Array<int>({1}), {&solid, &permeability, fraction}), Error);
   }
   CHECK_THROWS_WITH(table.Set(Array<int>({1}), {&solid, &permeability, 1.5}),
                     "the solid fraction is 1.5; it must lie between 0 and 1");
   CHECK_FALSE(table.Has(1));
}
