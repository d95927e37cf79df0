// ranks: 1 2 3
//
// What "auto" makes of a problem's size, and how anisotropic its solids are.

#include "support/boxes.hpp"
#include "support/meniscus_fibers.hpp"
#include "synovia/fem/moduli_ratios.hpp"
#include "synovia/fem/node_positions.hpp"
#include "synovia/general/reduce.hpp"
#include "synovia/materials/solids/fiber_pow_linear.hpp"
#include "synovia/synovia.hpp"

#include <catch2/catch.hpp>

using namespace mfem;
using namespace synovia;

namespace
{
/// The two boxes' solids, looked at by all ranks.
ModuliRatios Ratios(const SolidLaw &lower, const SolidLaw &upper)
{
   BoxOptions box;
   NamedMesh mesh = MakeStack(box, box);
   const ConstantPermeability permeability(1e-3);
   MaterialTable materials;
   materials.Set(mesh.Region("lower"), {&lower, &permeability, 0.2});
   materials.Set(mesh.Region("upper"), {&upper, &permeability, 0.2});
   return FindModuliRatios(mesh.Get(), materials);
}
} // namespace

TEST_CASE("The worst ratios of moduli count, on whatever rank they are")
{
   const real_t nu = 0.45;
   const IsotropicElastic soft(0.5, 0.1);
   const IsotropicElastic tight(0.5, nu);
   for (const ModuliRatios &ratios : {Ratios(soft, tight), Ratios(tight, soft)})
   {
      CHECK(ratios.anisotropy == Approx(1.0).epsilon(1e-12));
      CHECK(ratios.incompressibility ==
            Approx(2.0 * (1.0 - nu) / (1.0 - 2.0 * nu)).epsilon(1e-12));
   }
   const CartesianFrame along({0.0, 1.0, 0.0});
   const CartesianFrame across({1.0, 1.0, 0.0});
   const CartesianFrame askew({3.0, 2.0, 1.0});
   const TransverselyIsotropic straight(MeniscusFibers(), along);
   const TransverselyIsotropic oblique(MeniscusFibers(), across);
   const TransverselyIsotropic skew(MeniscusFibers(), askew);
   const real_t all = Ratios(soft, straight).anisotropy;
   CHECK(all > 500.0);
   CHECK(Ratios(oblique, soft).anisotropy == Approx(all).epsilon(0.01));
   // Between the directions that are looked at.
   CHECK(Ratios(skew, soft).anisotropy > 0.2 * all);
   CHECK(Ratios(skew, soft).anisotropy < all);
}

TEST_CASE("Fibers that are slack as meshed count as they are when stretched")
{
   const NeoHookean matrix(0.5, 0.1);
   CHECK(Ratios(matrix, matrix).anisotropy == Approx(1.0).epsilon(1e-12));
   const CartesianFrame along({0.0, 1.0, 0.0});
   const FiberPowLinear fibers(100.0, 1.01, 3.0, FiberDirection(along));
   const SolidMixture reinforced({&matrix, &fibers});
   CHECK(Ratios(matrix, reinforced).anisotropy > 100.0);
}

TEST_CASE("Fibers along three axes leave no direction soft")
{
   const real_t fiber_modulus = 100.0;
   const NeoHookean matrix(0.5, 0.1);
   const CartesianFrame frame({1.0, 2.0, 2.0});
   const auto along = [&](const Point3 &axis)
   {
      return FiberPowLinear(fiber_modulus, 1.001, 3.0,
                            FiberDirection(frame, axis));
   };
   const FiberPowLinear first = along({{1.0, 0.0, 0.0}});
   const FiberPowLinear second = along({{0.0, 1.0, 0.0}});
   const FiberPowLinear third = along({{0.0, 0.0, 1.0}});
   const SolidMixture two({&matrix, &first, &second});
   const SolidMixture three({&matrix, &first, &second, &third});
   CHECK(Ratios(matrix, two).anisotropy > 30.0);
   const real_t cubic = Ratios(matrix, three).anisotropy;
   CHECK(cubic > 1.5);
   CHECK(cubic < 3.0);
}

TEST_CASE("Displacements know the anisotropy of the elements around them")
{
   BoxOptions box;
   box.nx = box.ny = box.nz = 2;
   NamedMesh mesh = MakeStack(box, box);
   const IsotropicElastic soft(0.5, 0.1);
   const CartesianFrame along({0.0, 1.0, 0.0});
   const TransverselyIsotropic fibers(MeniscusFibers(), along);
   const ConstantPermeability permeability(1e-3);
   MaterialTable materials;
   materials.Set(mesh.Region("lower"), {&soft, &permeability, 0.2});
   materials.Set(mesh.Region("upper"), {&fibers, &permeability, 0.2});
   BiphasicSpaces spaces(mesh.Get(), 1);
   const real_t largest = FindModuliRatios(mesh.Get(), materials).anisotropy;
   const Vector anisotropy = FindAnisotropy(spaces, materials);
   const Vector positions = NodePositions(spaces.Displacement());
   REQUIRE(anisotropy.Size() == positions.Size());
   int upper = 0;
   for (int dof = 0; dof < anisotropy.Size(); dof++)
   {
      // The upper box stands on the lower one, on nodes of its own.
      const real_t height = positions[dof / 3 * 3 + 2];
      const bool has_fibers = anisotropy[dof] > 2.0;
      CAPTURE(dof, height);
      CHECK(anisotropy[dof] ==
            Approx(has_fibers ? largest : 1.0).epsilon(1e-12));
      CHECK((has_fibers ? height >= 1.0 - 1e-12 : height <= 1.0 + 1e-12));
      upper += has_fibers;
   }
   CHECK(SumOverRanks(upper, mesh.GetComm()) == 81);
}

TEST_CASE("The method follows from the size and from fibers")
{
   LinearOptions options;
   options.direct_below = 1000;
   options.direct_below_with_fibers = 500;
   CHECK(ChooseMethod(options, 1000, false) == LinearMethod::direct);
   CHECK(ChooseMethod(options, 1001, false) == LinearMethod::block_amg);
   CHECK(ChooseMethod(options, 500, true) == LinearMethod::direct);
   CHECK(ChooseMethod(options, 501, true) == LinearMethod::block_amg);
   options.method = LinearMethod::direct;
   CHECK(ChooseMethod(options, 1001, true) == LinearMethod::direct);
   options.method = LinearMethod::block_amg;
   CHECK(ChooseMethod(options, 1, false) == LinearMethod::block_amg);
}
