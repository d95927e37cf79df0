// ranks: 1 2 3
// timeout: 300
//
// Gap, pressure jump, nodal forces and nodal flows between two surfaces that
// deform and slide by more than a face: derivatives against differences,
// balance of forces and moments, and turns.

#include "synovia/contact/finite_gap.hpp"
#include "support/boxes.hpp"
#include "support/stack_displacement.hpp"
#include "synovia/fem/node_positions.hpp"
#include "synovia/general/reduce.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <string>

using namespace mfem;
using namespace synovia;

namespace
{
constexpr real_t difference_step = 1e-6;
constexpr real_t difference_tolerance = 1e-7;
constexpr real_t round_off = 1e-12;
// So small that faces bear parts.
constexpr real_t bearing_angle = 0.02;

struct Shape
{
   Element::Type type = Element::HEXAHEDRON;
   int order = 2;
   bool curved = false;
};

Mesh MakeBodies(const Shape &shape)
{
   BoxOptions lower;
   lower.nx = 3;
   lower.ny = 3;
   lower.nz = 1;
   lower.type = shape.type;
   BoxOptions upper = lower;
   upper.nx = 4;
   upper.ny = 5;
   // The rim of the upper body lies over faces of the lower one.
   upper.size_y = 0.8;
   Mesh mesh = MakeStackMesh(lower, upper);
   if (shape.curved)
   {
      mesh.SetCurvature(2);
      mesh.Transform(
         [](const Vector &x, Vector &y)
         {
            y = x;
            y[2] += 0.2 * x[0] * x[0] - 0.1 * x[1] * x[0];
         });
   }
   return mesh;
}

NamedMesh Distribute(const Shape &shape, MPI_Comm comm)
{
   Mesh mesh = MakeBodies(shape);
   return DistributeStack(mesh, comm);
}

class Bodies
{
public:
   explicit Bodies(const Shape &shape, MPI_Comm comm = MPI_COMM_WORLD)
      : mesh(Distribute(shape, comm)), spaces(mesh.Get(), shape.order),
        source(spaces, mesh.Boundary("upper_z0")),
        destination(spaces, mesh.Boundary("lower_z1")),
        destination_areas(NodalAreas(destination)),
        gap(source, destination, destination_areas, Options())
   {
   }

   // Bent, stretched and sheared; the upper body lies deeper by @a depth
   // and further by @a slide.
   Vector Displacement(real_t depth, real_t slide)
   {
      const auto bend = [](const Vector &x, Vector &u)
      {
         u[0] = 0.1 * x[0] * x[1] + 0.05 * std::sin(3.0 * x[1]);
         u[1] = -0.2 * x[1] + 0.05 * x[0] * x[0];
         u[2] = 0.1 * std::sin(2.0 * x[0] + x[1]) - 0.1 * x[2];
      };
      return StackDisplacement(spaces, bend,
                               [=](const Vector &x, Vector &u)
                               {
                                  bend(x, u);
                                  u[0] += slide;
                                  u[2] += 0.03 * std::cos(4.0 * x[0]) - depth;
                               });
   }

   void Search(const Vector &u)
   {
      Move(u);
      gap.Search();
      gap.Search(gap.FindBearing(bearing_angle));
   }
   void Follow(const Vector &u)
   {
      Move(u);
      gap.Follow();
   }

   Vector Random(int size, int seed) const
   {
      Vector x(size);
      x.Randomize(seed + 17 * Mpi::WorldRank());
      for (real_t &value : x)
      {
         value = 2.0 * value - 1.0;
      }
      return x;
   }
   Vector RandomForces(int seed) const
   {
      Vector forces = Random(gap.Gap().Size(), seed);
      forces *= gap.Operators().area;
      return forces;
   }

   NamedMesh mesh;
   BiphasicSpaces spaces;
   ContactSurface source;
   ContactSurface destination;
   Vector destination_areas;
   FiniteGap gap;

private:
   void Move(const Vector &u)
   {
      source.SetDisplacement(u);
      destination.SetDisplacement(u);
   }
   static GapOptions Options()
   {
      GapOptions options;
      options.search_radius = 0.4;
      return options;
   }
};

Shape AnyShape()
{
   Shape shape;
   shape.type = GENERATE(Element::HEXAHEDRON, Element::TETRAHEDRON);
   shape.order = GENERATE(1, 2);
   shape.curved = GENERATE(false, true);
   return shape;
}

std::string ToText(const Shape &shape)
{
   return "element " + std::to_string(static_cast<int>(shape.type)) +
          ", order " + std::to_string(shape.order) +
          (shape.curved ? ", curved" : "");
}

real_t Norm(const Vector &x)
{
   return std::sqrt(InnerProduct(MPI_COMM_WORLD, x, x));
}

Vector Times(const HypreParMatrix &matrix, const Vector &x)
{
   Vector y(matrix.Height());
   matrix.Mult(x, y);
   return y;
}

Vector TransposeTimes(const HypreParMatrix &matrix, const Vector &x)
{
   Vector y(matrix.Width());
   matrix.MultTranspose(x, y);
   return y;
}

// What there is at one displacement.
struct Values
{
   Vector gap;
   Vector jump;
   Vector force;
   Vector flow;
};
} // namespace

TEST_CASE("Derivatives of gap, jump, forces and flows agree with differences")
{
   const Shape shape = AnyShape();
   INFO(ToText(shape));
   Bodies bodies(shape);
   bodies.Search(bodies.Displacement(0.02, 0.0));
   const Vector u = bodies.Displacement(0.03, 0.15);
   bodies.Follow(u);
   CHECK(bodies.gap.Pairing().HasDrifted());
   const Vector nodal_force = bodies.RandomForces(3);
   const Vector nodal_flow = bodies.RandomForces(4);
   const Vector p = bodies.Random(bodies.spaces.Pressure().GetTrueVSize(), 5);
   GapDerivatives &derivatives = bodies.gap.Derivatives();
   derivatives.Start(p, nodal_force, nodal_flow);
   derivatives.Integrate();
   derivatives.Assemble();
   const Vector area(bodies.gap.Operators().area);
   CHECK(SumOverRanks(area.Sum(), MPI_COMM_WORLD) <
         0.99 * SumOverRanks(bodies.gap.Operators().own_area.Sum(),
                             MPI_COMM_WORLD));

   const auto evaluate = [&](const Vector &at)
   {
      bodies.Follow(at);
      Vector change(bodies.gap.Operators().area);
      change -= area;
      CHECK(Norm(change) <= round_off * Norm(area));
      const GapOperators &operators = bodies.gap.Operators();
      return Values{bodies.gap.Gap(), Times(*operators.jump, p),
                    TransposeTimes(*operators.gap, nodal_force),
                    TransposeTimes(*operators.jump, nodal_flow)};
   };
   for (int seed = 1; seed <= 3; seed++)
   {
      const Vector direction = bodies.Random(u.Size(), seed);
      Vector ahead(u);
      Vector behind(u);
      ahead.Add(difference_step, direction);
      behind.Add(-difference_step, direction);
      const Values plus = evaluate(ahead);
      const Values minus = evaluate(behind);
      const auto compare = [&](const char *what, const Vector &after,
                               const Vector &before,
                               const HypreParMatrix &derivative)
      {
         CAPTURE(what);
         Vector difference(after);
         difference -= before;
         difference *= 0.5 / difference_step;
         const Vector exact = Times(derivative, direction);
         const real_t size = Norm(exact);
         CHECK(size > 0.0);
         difference -= exact;
         CHECK(Norm(difference) <= difference_tolerance * size);
      };
      compare("gap", plus.gap, minus.gap, derivatives.Gap());
      compare("jump", plus.jump, minus.jump, derivatives.Jump());
      compare("force", plus.force, minus.force, derivatives.Force());
      compare("flow", plus.flow, minus.flow, derivatives.Outflow());
   }
}

TEST_CASE("Trial states leave no trace in what points hit")
{
   const Shape shape = AnyShape();
   INFO(ToText(shape));
   Bodies bodies(shape);
   bodies.Search(bodies.Displacement(0.02, 0.0));
   const Vector u = bodies.Displacement(0.03, 0.15);
   bodies.Follow(u);
   const Vector gap(bodies.gap.Gap());
   const Vector area(bodies.gap.Operators().area);
   const std::size_t points = bodies.gap.Pairing().Points().size();

   bodies.gap.Remember();
   bodies.Follow(bodies.Displacement(0.03, 0.9));
   const int lost =
      static_cast<int>(points - bodies.gap.Pairing().Points().size());
   CHECK(SumOverRanks(lost, MPI_COMM_WORLD) > 0);
   for (int time = 0; time < 2; time++)
   {
      bodies.gap.GoBack();
      bodies.Follow(u);
      CHECK(bodies.gap.Pairing().Points().size() == points);
      CHECK(bodies.gap.Pairing().HasDrifted());
      for (int j = 0; j < gap.Size(); j++)
      {
         CHECK(bodies.gap.Gap()[j] == Approx(gap[j]).margin(1e-12));
         CHECK(bodies.gap.Operators().area[j] == Approx(area[j]).margin(1e-12));
      }
      bodies.Follow(bodies.Displacement(0.0, -0.9));
   }
}

TEST_CASE("Nodal forces and their moments are in balance")
{
   const Shape shape = AnyShape();
   INFO(ToText(shape));
   Bodies bodies(shape);
   const Vector u = bodies.Displacement(0.03, 0.15);
   bodies.Search(bodies.Displacement(0.02, 0.0));
   bodies.Follow(u);
   const Vector force =
      TransposeTimes(*bodies.gap.Operators().gap, bodies.RandomForces(3));
   if (shape.curved && shape.order == 1)
   {
      // The geometry is not that of the displacement's nodes.
      return;
   }
   Vector position = NodePositions(bodies.spaces.Displacement());
   position += u;
   real_t sums[12] = {};
   for (int i = 0; i < force.Size(); i += 3)
   {
      const Point3 f{force[i], force[i + 1], force[i + 2]};
      const Point3 x{position[i], position[i + 1], position[i + 2]};
      const Point3 moment = Cross(x, f);
      for (int d = 0; d < 3; d++)
      {
         sums[d] += f[d];
         sums[3 + d] += moment[d];
         sums[6 + d] += std::abs(f[d]);
         sums[9 + d] += std::abs(moment[d]);
      }
   }
   for (real_t &sum : sums)
   {
      sum = SumOverRanks(sum, MPI_COMM_WORLD);
   }
   for (int i = 0; i < 3; i++)
   {
      CHECK(sums[6 + i] > 0.0);
      CHECK(std::abs(sums[i]) <= round_off * sums[6 + i]);
   }
   for (int i = 3; i < 6; i++)
   {
      CHECK(std::abs(sums[i]) <= round_off * sums[6 + i]);
   }
}
