// ranks: 1 2
//
// Corners of elements of order 1 whose det F falls below the solid fraction
// resist, with a complete tangent, and none turns inside out.

#include "synovia/fem/corner_barrier.hpp"
#include "support/boxes.hpp"
#include "synovia/fem/boundary_conditions.hpp"
#include "synovia/fem/total_lagrangian_form.hpp"
#include "synovia/materials/permeabilities/constant_permeability.hpp"
#include "synovia/materials/solids/neo_hookean.hpp"

#include <catch2/catch.hpp>

#include <memory>

using namespace mfem;
using namespace synovia;

namespace
{
constexpr real_t solid_fraction = 0.2;

/// Two elements beside each other, each a unit cube or half of one; the vertex
/// at (2, 1, 1) is moved by (-d, -d, -d). In a hexahedron det F is 1 - 3 d
/// there, and 1 - 1.87 d at the next of Gauss' points. In wedges it is 1 - 2 d.
class PressedCorner
{
public:
   PressedCorner(real_t d, real_t fraction = solid_fraction,
                 Element::Type type = Element::HEXAHEDRON)
      : mesh(MakeBox(TwoCells(type))), spaces(mesh.Get(), 1),
        conditions(spaces, Deformation::finite)
   {
      materials.Set(mesh.Region("body"), {&solid, &law, fraction});
      form = std::make_unique<TotalLagrangianForm>(
         mesh, spaces, materials, conditions.Springs(), conditions.Followers());
      VectorFunctionCoefficient moved(
         3, [d](const Vector &x, Vector &u)
         { u = x[0] > 1.5 && x[1] > 0.5 && x[2] > 0.5 ? -d : 0.0; });
      ParGridFunction u(&spaces.Displacement());
      u.ProjectCoefficient(moved);
      u.GetTrueDofs(stage.u);
      stage.u0 = stage.u;
      stage.p.SetSize(spaces.Pressure().GetTrueVSize());
      stage.p = 0.0;
      stage.p0 = stage.p;
      stage.dt = 1.0;
      form->GetConserved(stage.u0, stage.conserved0);
      form->StartStage(stage, stage.p, stage.dt);
   }

   std::string Validate() const { return form->Validate(stage); }

   Vector Forces() const { return ForcesAt(0.0, stage.u); }

   /// Along the way that the vertex has gone.
   real_t Resistance() const
   {
      return InnerProduct(MPI_COMM_WORLD, Forces(), stage.u) /
             std::sqrt(InnerProduct(MPI_COMM_WORLD, stage.u, stage.u));
   }

   /// Relative to the tangent's change of forces with a random displacement.
   real_t ErrorOfTangent()
   {
      constexpr real_t step = 1e-6;
      Vector du(stage.u.Size());
      du.Randomize(1 + Mpi::WorldRank());
      Vector differences = ForcesAt(step, du);
      differences -= ForcesAt(-step, du);
      differences /= 2.0 * step;
      form->Linearize(stage);
      Vector change(du.Size());
      form->Tangent().stiffness->Mult(du, change);
      differences -= change;
      return std::sqrt(InnerProduct(MPI_COMM_WORLD, differences, differences) /
                       InnerProduct(MPI_COMM_WORLD, change, change));
   }

private:
   static BoxOptions TwoCells(Element::Type type)
   {
      BoxOptions box;
      box.nx = 2;
      box.nz = 1;
      box.size_x = 2.0;
      box.type = type;
      return box;
   }

   Vector ForcesAt(real_t step, const Vector &du) const
   {
      BodyStage moved(stage);
      moved.u.Add(step, du);
      Vector momentum;
      Vector mass;
      form->Mult(moved, momentum, mass);
      return momentum;
   }

   const NeoHookean solid{1.0, 0.3};
   const ConstantPermeability law{1.0};
   NamedMesh mesh;
   BiphasicSpaces spaces;
   BoundaryConditions conditions;
   MaterialTable materials;
   std::unique_ptr<TotalLagrangianForm> form;
   BodyStage stage;
};

/// Where det F of the corner is J.
real_t Depth(Element::Type type, real_t J)
{
   return (1.0 - J) / (type == Element::WEDGE ? 2.0 : 3.0);
}
} // namespace

TEST_CASE("A corner that would turn inside out is refused")
{
   CHECK(PressedCorner(0.333).Validate() == "");
   CHECK_THAT(PressedCorner(0.334).Validate(),
              Catch::Contains("is turned inside out in a corner at (2, 1, 1)"));
}

TEST_CASE("A corner resists without bounds below the solid fraction")
{
   const auto type = GENERATE(Element::HEXAHEDRON, Element::WEDGE);
   CAPTURE(static_cast<int>(type));
   const auto d_of = [type](real_t J) { return Depth(type, J); };
   constexpr real_t small_fraction = 1e-6;
   const auto by_barrier = [&](real_t J)
   {
      return PressedCorner(d_of(J), solid_fraction, type).Resistance() -
             PressedCorner(d_of(J), small_fraction, type).Resistance();
   };
   CHECK(by_barrier(0.4) == 0.0);
   const real_t little = by_barrier(0.1);
   CHECK(little > 0.0);
   CHECK(by_barrier(0.01) > 500.0 * little);
}

TEST_CASE("The tangent of a corner's resistance is complete")
{
   const auto type = GENERATE(Element::HEXAHEDRON, Element::WEDGE);
   CAPTURE(static_cast<int>(type));
   for (const real_t J : {0.15, 0.05})
   {
      CAPTURE(J);
      const real_t d = Depth(type, J);
      CHECK(PressedCorner(d, solid_fraction, type).ErrorOfTangent() < 1e-7);
   }
}

TEST_CASE("A tetrahedron of order 1 has no corners of its own")
{
   PressedCorner some(0.3, solid_fraction, Element::TETRAHEDRON);
   PressedCorner none(0.3, 1e-6, Element::TETRAHEDRON);
   Vector difference = some.Forces();
   difference -= none.Forces();
   CHECK(difference.Normlinf() == 0.0);
}
