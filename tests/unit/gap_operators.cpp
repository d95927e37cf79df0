// ranks: 1 2 3 4
// timeout: 300
//
// The gap and pressure jump between two boxes on top of each other, whose
// meshes do not match: what they must be, exactly, for simple fields.

#include "synovia/contact/gap_operators.hpp"
#include "support/boxes.hpp"
#include "support/stack_displacement.hpp"

#include <catch2/catch.hpp>

#include <cmath>

using namespace mfem;
using namespace synovia;

namespace
{
constexpr real_t round_off = 1e-12;

enum class Shape
{
   flat,
   // Parabolic, both bodies alike.
   curved,
   // The upper body narrower than the lower one.
   narrow,
   // Flat with a gap between the bodies.
   apart
};

BoxOptions Lower(Element::Type type)
{
   BoxOptions box;
   box.nx = 3;
   box.ny = 3;
   box.nz = 1;
   box.type = type;
   return box;
}

Mesh MakeBodies(Element::Type type, Shape shape)
{
   const BoxOptions lower = Lower(type);
   BoxOptions upper = lower;
   upper.nx = 2;
   upper.ny = 2;
   if (shape == Shape::narrow)
   {
      upper.size_x = 0.6;
      upper.size_y = 0.6;
   }
   Mesh mesh = MakeStackMesh(lower, upper);
   if (shape == Shape::curved)
   {
      mesh.SetCurvature(2);
      mesh.Transform(
         [](const Vector &x, Vector &y)
         {
            y = x;
            y[2] += 0.2 * x[0] * x[0] - 0.1 * x[0] * x[1];
         });
   }
   if (shape == Shape::apart)
   {
      for (int i = MakeBoxMesh(lower).GetNV(); i < mesh.GetNV(); i++)
      {
         mesh.GetVertex(i)[2] += 0.01;
      }
   }
   return mesh;
}

// The operators from the lower body (destination) to the upper one.
class Fixture
{
public:
   Fixture(Element::Type type, int order, Shape shape = Shape::flat)
      : mesh(Distribute(type, shape)), spaces(mesh.Get(), order),
        upper(spaces, mesh.Boundary("upper_z0")),
        lower(spaces, mesh.Boundary("lower_z1"))
   {
      Assemble();
   }

   void Assemble()
   {
      GapOptions options;
      options.search_radius = 0.5;
      options.quadrature_order = 10;
      operators = AssembleGapOperators(upper, lower, options);
   }

   // True dofs of a field that each body has its own formula for.
   Vector Displacement(std::function<void(const Vector &, Vector &)> on_lower,
                       std::function<void(const Vector &, Vector &)> on_upper)
   {
      return StackDisplacement(spaces, std::move(on_lower),
                               std::move(on_upper));
   }

   Vector Pressure(std::function<real_t(const Vector &)> on_lower,
                   std::function<real_t(const Vector &)> on_upper)
   {
      FunctionCoefficient low(on_lower);
      FunctionCoefficient high(on_upper);
      PWCoefficient both;
      both.UpdateCoefficient(1, low);
      both.UpdateCoefficient(2, high);
      ParGridFunction field(&spaces.Pressure());
      field.ProjectCoefficient(both);
      Vector p;
      field.GetTrueDofs(p);
      return p;
   }

   Vector Gap(const Vector &u) const
   {
      Vector gap(operators.gap->Height());
      operators.gap->Mult(u, gap);
      return gap;
   }

   Vector Jump(const Vector &p) const
   {
      Vector jump(operators.jump->Height());
      operators.jump->Mult(p, jump);
      return jump;
   }

   // int phi_j f / int phi_j over the destination, by a linear form of MFEM's.
   Vector Weighted(std::function<real_t(const Vector &)> f)
   {
      const auto integrate = [&](Coefficient &coefficient)
      {
         Array<int> marker(mesh.Get().bdr_attributes.Max());
         marker = 0;
         marker[mesh.Boundary("lower_z1")[0] - 1] = 1;
         ParLinearForm form(&spaces.Multiplier());
         form.AddBoundaryIntegrator(new BoundaryLFIntegrator(coefficient, 0, 8),
                                    marker);
         form.Assemble();
         Vector result(spaces.Multiplier().GetTrueVSize());
         form.ParallelAssemble(result);
         return lower.Vertices().FromTrueDofs(result);
      };
      FunctionCoefficient given(f);
      ConstantCoefficient one(1.0);
      Vector result = integrate(given);
      const Vector area = integrate(one);
      for (int j = 0; j < result.Size(); j++)
      {
         result[j] = area[j] > 0.0 ? result[j] / area[j] : 0.0;
      }
      return result;
   }

   real_t Sum(const Vector &x) const
   {
      real_t sum = x.Sum();
      MPI_Allreduce(MPI_IN_PLACE, &sum, 1, MPITypeMap<real_t>::mpi_type,
                    MPI_SUM, mesh.GetComm());
      return sum;
   }

   // 1 for the vertices of the destination that see the source.
   Vector Present() const
   {
      Vector present(operators.area);
      for (int j = 0; j < present.Size(); j++)
      {
         present[j] = present[j] > 0.0 ? 1.0 : 0.0;
      }
      return present;
   }

   NamedMesh mesh;
   BiphasicSpaces spaces;
   ContactSurface upper;
   ContactSurface lower;
   GapOperators operators;

private:
   static NamedMesh Distribute(Element::Type type, Shape shape)
   {
      Mesh serial = MakeBodies(type, shape);
      return DistributeStack(serial, MPI_COMM_WORLD);
   }
};

void Zero(const Vector &, Vector &u)
{
   u = 0.0;
}

std::function<void(const Vector &, Vector &)> Constant(Point3 value)
{
   return [value](const Vector &, Vector &u)
   {
      for (int d = 0; d < 3; d++)
      {
         u[d] = value[d];
      }
   };
}

// omega x X
void Rotation(const Vector &x, Vector &u)
{
   const real_t omega[3] = {0.3, -0.7, 0.5};
   for (int d = 0; d < 3; d++)
   {
      const int e = (d + 1) % 3;
      const int f = (d + 2) % 3;
      u[d] = omega[e] * x[f] - omega[f] * x[e];
   }
}

real_t Largest(const Vector &x)
{
   return x.Size() > 0 ? x.Normlinf() : 0.0;
}

real_t Difference(const Vector &x, const Vector &y)
{
   Vector difference(x);
   difference -= y;
   return Largest(difference);
}

Fixture MakeFixture(Shape shape)
{
   const auto type = GENERATE(Element::HEXAHEDRON, Element::TETRAHEDRON);
   const int order = GENERATE(1, 2, 3);
   UNSCOPED_INFO("element " << static_cast<int>(type) << ", order " << order);
   return Fixture(type, order, shape);
}
} // namespace

TEST_CASE("A common translation opens no gap, and a common pressure no jump")
{
   const auto shape =
      GENERATE(Shape::flat, Shape::curved, Shape::narrow, Shape::apart);
   CAPTURE(static_cast<int>(shape));
   Fixture f = MakeFixture(shape);
   for (int d = 0; d < 3; d++)
   {
      Point3 shift{{0.0, 0.0, 0.0}};
      shift[d] = 1.0;
      CHECK(Largest(f.Gap(f.Displacement(Constant(shift), Constant(shift)))) <=
            round_off);
   }
   const auto one = [](const Vector &) { return 1.0; };
   const auto zero = [](const Vector &) { return 0.0; };
   CHECK(Largest(f.Jump(f.Pressure(one, one))) <= round_off);
   // What the source alone has is the whole jump.
   CHECK(Difference(f.Jump(f.Pressure(zero, one)), f.Present()) <= round_off);
}

TEST_CASE("A small common rotation opens no gap")
{
   // Even where there is one: x_A - x_B has the direction of the normal.
   const auto shape =
      GENERATE(Shape::flat, Shape::curved, Shape::narrow, Shape::apart);
   CAPTURE(static_cast<int>(shape));
   Fixture f = MakeFixture(shape);
   if (shape == Shape::curved && f.spaces.Order() == 1)
   {
      // Displacements of order 1 don't follow a curved surface.
      CHECK(f.Gap(f.Displacement(Zero, Zero)).Norml2() == 0.0);
      return;
   }
   CHECK(Largest(f.Gap(f.Displacement(Rotation, Rotation))) <= round_off);
}

TEST_CASE("A large common translation keeps the gap")
{
   const auto shape = GENERATE(Shape::flat, Shape::apart, Shape::curved);
   CAPTURE(static_cast<int>(shape));
   Fixture f = MakeFixture(shape);
   Vector present = f.Present();
   present *= shape == Shape::apart ? 0.01 : 0.0;
   CHECK(Difference(f.operators.gap_offset, present) <= round_off);
   const auto shift = Constant({{5.0, 0.25, -3.0}});
   const Vector u = f.Displacement(shift, shift);
   f.upper.SetDisplacement(u);
   f.lower.SetDisplacement(u);
   f.Assemble();
   Vector gap = f.Gap(u);
   gap += f.operators.gap_offset;
   CHECK(Difference(gap, present) <= round_off);
}

TEST_CASE("Normals stay when surfaces deform")
{
   // What is pressed down along a slope would turn normals that follow.
   Fixture f = MakeFixture(Shape::flat);
   const auto slope = [](const Vector &x, Vector &u)
   {
      u = 0.0;
      u[2] = 0.3 * x[0];
   };
   const Vector u = f.Displacement(slope, slope);
   f.upper.SetDisplacement(u);
   f.lower.SetDisplacement(u);
   f.Assemble();
   const auto sideways = Constant({{1.0, 0.0, 0.0}});
   CHECK(Largest(f.Gap(f.Displacement(Zero, sideways))) <= round_off);
   CHECK(Difference(f.Gap(f.Displacement(Zero, Constant({{0.0, 0.0, 1.0}}))),
                    f.Present()) <= round_off);
}

TEST_CASE("The gap of linear fields is exact")
{
   Fixture f = MakeFixture(Shape::flat);
   const auto lower_field = [](const Vector &x, Vector &u)
   {
      u[0] = 0.3 * x[1];
      u[1] = 1.0;
      u[2] = 0.1 - 0.2 * x[0] + 0.5 * x[1];
   };
   const auto upper_field = [](const Vector &x, Vector &u)
   {
      u[0] = -2.0 * x[0];
      u[1] = 0.7 * x[2];
      u[2] = -0.3 + 0.4 * x[0] - 0.6 * x[1] + 0.2 * x[2];
   };
   const auto exact_gap = [](const Vector &x)
   { return -0.2 + 0.6 * x[0] - 1.1 * x[1]; };
   CHECK(Difference(f.Gap(f.Displacement(lower_field, upper_field)),
                    f.Weighted(exact_gap)) <= round_off);

   const auto lower_p = [](const Vector &x) { return 1.0 + x[0]; };
   const auto upper_p = [](const Vector &x) { return 3.0 - x[1] + x[2]; };
   const auto exact_jump = [](const Vector &x) { return 3.0 - x[0] - x[1]; };
   CHECK(Difference(f.Jump(f.Pressure(lower_p, upper_p)),
                    f.Weighted(exact_jump)) <= round_off);
}

TEST_CASE("Curved surfaces that coincide have no gap")
{
   const Fixture f = MakeFixture(Shape::curved);
   CHECK(Largest(f.operators.gap_offset) <= round_off);
   CHECK(f.Sum(f.Present()) == Approx(16.0));
}

TEST_CASE("The areas add up")
{
   const auto shape = GENERATE(Shape::flat, Shape::curved, Shape::apart);
   CAPTURE(static_cast<int>(shape));
   const Fixture f = MakeFixture(shape);
   const GapOperators &operators = f.operators;
   const Vector areas = NodalAreas(f.lower);
   // Two quadratures of a curved surface.
   const real_t tolerance = shape == Shape::curved ? 1e-5 : round_off;
   CHECK(Difference(operators.area, areas) <= tolerance);
   const real_t area = f.Sum(NodalAreas(f.upper));
   CHECK(f.Sum(areas) == Approx(area).epsilon(tolerance));
   if (shape == Shape::flat)
   {
      CHECK(area == Approx(1.0).epsilon(round_off));
   }

   // Summed over source vertices, the coverage is the area of a destination
   // vertex.
   Vector ones(operators.coverage->Height());
   ones = 1.0;
   Vector covering(operators.coverage->Width());
   operators.coverage->MultTranspose(ones, covering);
   CHECK(Difference(covering, operators.area) <= round_off);
   // Summed over destination vertices, that of a source vertex.
   ones.SetSize(operators.coverage->Width());
   ones = 1.0;
   Vector covered(operators.coverage->Height());
   operators.coverage->Mult(ones, covered);
   CHECK(Difference(covered, NodalAreas(f.upper)) <= tolerance);
   CHECK(f.Sum(covered) == Approx(f.Sum(operators.area)));
}

TEST_CASE("Vertices that see nothing have no rows")
{
   Fixture f = MakeFixture(Shape::narrow);
   // The source's rim cuts through the destination's faces.
   CHECK(f.Sum(f.operators.area) == Approx(0.36).epsilon(round_off));
   // 0 and 1/3 and 2/3, the face from 1/3 to 2/3 being cut at 0.6.
   CHECK(f.Sum(f.Present()) == Approx(9.0));
   const auto up = Constant({{0.0, 0.0, 1.0}});
   const Vector gap = f.Gap(f.Displacement(Zero, up));
   CHECK(Difference(gap, f.Present()) <= round_off);
   Vector absent(f.operators.gap->Height());
   Vector some(f.operators.gap->Width());
   some.Randomize(7);
   f.operators.gap->AbsMult(1.0, some, 0.0, absent);
   for (int j = 0; j < absent.Size(); j++)
   {
      CHECK((f.operators.area[j] > 0.0 || absent[j] == 0.0));
   }
}

TEST_CASE("Tractions on both sides are in balance")
{
   const auto shape =
      GENERATE(Shape::flat, Shape::curved, Shape::narrow, Shape::apart);
   CAPTURE(static_cast<int>(shape));
   Fixture f = MakeFixture(shape);
   Vector nodal(f.operators.gap->Height());
   nodal.Randomize(1 + Mpi::WorldRank());
   nodal *= f.operators.area;
   Vector force(f.operators.gap->Width());
   f.operators.gap->MultTranspose(nodal, force);
   for (int d = 0; d < 3; d++)
   {
      real_t on_source = 0.0;
      real_t on_destination = 0.0;
      for (const int dof : f.upper.DisplacementTrueDofs())
      {
         on_source += dof % 3 == d ? force[dof] : 0.0;
      }
      for (const int dof : f.lower.DisplacementTrueDofs())
      {
         on_destination += dof % 3 == d ? force[dof] : 0.0;
      }
      real_t sums[2] = {on_source, on_destination};
      MPI_Allreduce(MPI_IN_PLACE, sums, 2, MPITypeMap<real_t>::mpi_type,
                    MPI_SUM, f.mesh.GetComm());
      CHECK(std::abs(sums[0] + sums[1]) <= round_off);
      if (d == 2 && shape != Shape::curved)
      {
         CHECK(sums[0] == Approx(f.Sum(nodal)).epsilon(round_off));
      }
   }
   // So are their moments, since all forces have the direction from one to the
   // other: the work on a rotation is nil.
   if (shape != Shape::curved || f.spaces.Order() > 1)
   {
      const Vector rotation = f.Displacement(Rotation, Rotation);
      Vector work(1);
      work[0] = force * rotation;
      CHECK(std::abs(f.Sum(work)) <= round_off);
   }
}
