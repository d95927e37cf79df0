// ranks: 1 2 3
//
// What "auto" makes of a problem's size and of its solids.

#include "support/boxes.hpp"
#include "support/meniscus_fibers.hpp"
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
   const TransverselyIsotropic straight(MeniscusFibers(), along);
   const TransverselyIsotropic oblique(MeniscusFibers(), across);
   const real_t all = Ratios(soft, straight).anisotropy;
   CHECK(all > 500.0);
   // cos(45 degrees)^4 of it, but for what is between the fibers.
   CHECK(Ratios(oblique, soft).anisotropy == Approx(0.25 * all).epsilon(0.01));
}

TEST_CASE("The method follows from the size and from stiff fibers")
{
   LinearOptions options;
   options.direct_below = 1000;
   const ModuliRatios ordinary{2.0, 1.0};
   const ModuliRatios fibers{2.0, 500.0};
   CHECK(ChooseMethod(options, 1000, ordinary) == LinearMethod::direct);
   CHECK(ChooseMethod(options, 1001, ordinary) == LinearMethod::block_amg);
   CHECK(ChooseMethod(options, 2000, fibers) == LinearMethod::direct);
   CHECK(ChooseMethod(options, 2001, fibers) == LinearMethod::block_amg);
   options.method = LinearMethod::direct;
   CHECK(ChooseMethod(options, 2001, ordinary) == LinearMethod::direct);
   options.method = LinearMethod::block_amg;
   CHECK(ChooseMethod(options, 1, fibers) == LinearMethod::block_amg);
}
