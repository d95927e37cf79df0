// What the stabilization of order 1 takes of the volume: of a pressure that
// goes to and fro from one layer of nodes to the next by an amplitude a, a/H_A
// everywhere; of a linear one nothing.

#include "synovia/fem/stabilized_volume.hpp"
#include "support/boxes.hpp"
#include "synovia/runs/stabilization_record.hpp"
#include "synovia/synovia.hpp"

#include <catch2/catch.hpp>

#include <cmath>

using namespace mfem;
using namespace synovia;

TEST_CASE("Pressures from node to node stand for volume, linear ones don't")
{
   BoxOptions box;
   box.nx = box.ny = 2;
   box.nz = 6;
   NamedMesh mesh = MakeBox(box);
   BiphasicSpaces spaces(mesh.Get(), 1);
   const IsotropicElastic solid(0.5, 0.1);
   const ConstantPermeability permeability(1e-3);
   MaterialTable materials;
   materials.Set(mesh.Region("body"), {&solid, &permeability, 0.2});
   const VolumeMatrices matrices(spaces, materials);
   const StabilizedVolume volume(mesh, spaces, materials,
                                 *matrices.stabilization);

   const auto largest = [&](real_t (*pressure)(const Vector &))
   {
      ParGridFunction p(&spaces.Pressure());
      FunctionCoefficient coefficient([pressure](const Vector &x)
                                      { return pressure(x); });
      p.ProjectCoefficient(coefficient);
      Vector values;
      p.GetTrueDofs(values);
      return volume.FindLargest(values);
   };
   const StrainExtreme oscillation =
      largest([](const Vector &x) { return 0.03 * std::cos(6 * M_PI * x[2]); });
   CHECK(oscillation.value ==
         Approx(0.03 / solid.AggregateModulus()).epsilon(1e-10));
   CHECK(oscillation.region == "body");
   // A sum over ranks may be the larger of equal ones by round-off.
   CHECK(std::abs(6.0 * oscillation.place[2] -
                  std::round(6.0 * oscillation.place[2])) < 1e-12);
   const StrainExtreme linear =
      largest([](const Vector &x) { return 0.03 * x[2]; });
   CHECK(linear.value < 1e-12);

   StabilizationRecord record;
   CHECK(record.Add(linear, 1.0).empty());
   CHECK(record.Summary().empty());
   CHECK_THAT(record.Add(oscillation, 2.0),
              Catch::Contains("5.86667 %") && Catch::Contains("\"body\""));
   CHECK(record.Add(oscillation, 3.0).empty());
   CHECK_THAT(record.Summary(), Catch::Contains("t = 2"));
}
