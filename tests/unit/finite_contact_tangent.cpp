// ranks: 1 2 3
// timeout: 300
//
// What a contact pair adds to the balance in finite deformation, partly in
// contact, partly apart, partly sealed, curved, and slid on after the search,
// against differences:
//
//     momentum:  (G^T W R + force_change) du
//     mass:      (J^T W_p jump_change + outflow_change) du + J^T W_p J dp

#include "support/boxes.hpp"
#include "synovia/general/reduce.hpp"
#include "synovia/materials/permeabilities/constant_permeability.hpp"
#include "synovia/materials/solids/neo_hookean.hpp"
#include "synovia/synovia.hpp"

#include <catch2/catch.hpp>

#include <cmath>

using namespace mfem;
using namespace synovia;

namespace
{
constexpr real_t difference_step = 1e-7;
constexpr real_t difference_tolerance = 1e-6;

NamedMesh MakeBodies(bool curved)
{
   BoxOptions lower;
   lower.nx = 5;
   lower.ny = 5;
   lower.nz = 1;
   lower.type = Element::TETRAHEDRON;
   BoxOptions upper = lower;
   upper.nx = 3;
   upper.ny = 3;
   upper.type = Element::HEXAHEDRON;
   // The rim of the upper body covers some faces in part: in contact, but not
   // sealed.
   upper.size_y = 0.65;
   Mesh mesh = MakeStackMesh(lower, upper);
   if (curved)
   {
      mesh.SetCurvature(2);
      mesh.Transform(
         [](const Vector &x, Vector &y)
         {
            y = x;
            y[2] += 0.3 * x[0] * x[0] + 0.1 * x[1] * x[0];
         });
   }
   return DistributeStack(mesh, MPI_COMM_WORLD);
}

class Bodies
{
public:
   Bodies(int order, bool curved)
      : mesh(MakeBodies(curved)), spaces(mesh.Get(), order), solid(0.5, 0.1),
        fluid(4.0e-3)
   {
      materials.Set(mesh.Region("lower"), {&solid, &fluid, 0.2});
      materials.Set(mesh.Region("upper"), {&solid, &fluid, 0.2});
      ContactOptions options;
      options.search_radius = 0.5;
      options.overlap_limit = 1.0;
      pair = std::make_unique<ContactPair>(
         "pair", spaces, materials, mesh.Boundary("upper_z0"),
         mesh.Boundary("lower_z1"), options, Deformation::finite);
      pair->Search(Displacement(0.0));
      u = Displacement(0.07);
      p = Random(spaces.Pressure().GetTrueVSize(), 7);
      // Multipliers that are not zero.
      Evaluate(u, p);
      pair->Enforcement().Augment();
      Evaluate(u, p);
   }

   // The upper body overlaps the lower one for x < 0.5 and lifts off beyond;
   // it lies further by @a slide.
   Vector Displacement(real_t slide)
   {
      VectorFunctionCoefficient tilt(3,
                                     [=](const Vector &x, Vector &v)
                                     {
                                        v[0] = slide + 0.05 * x[1] * x[1];
                                        v[1] = 0.02 * std::sin(4.0 * x[0]);
                                        v[2] = 0.1 * (x[0] - 0.5);
                                     });
      VectorFunctionCoefficient press(3,
                                      [=](const Vector &x, Vector &v)
                                      {
                                         v[0] = 0.1 * x[0];
                                         v[1] = 0.0;
                                         v[2] = 0.02 * std::sin(3.0 * x[1]);
                                      });
      PWVectorCoefficient by_body(3);
      by_body.UpdateCoefficient(1, press);
      by_body.UpdateCoefficient(2, tilt);
      ParGridFunction field(&spaces.Displacement());
      field.ProjectCoefficient(by_body);
      Vector v;
      field.GetTrueDofs(v);
      return v;
   }

   // Says whether a vertex switched.
   bool Evaluate(const Vector &displacement, const Vector &pressure)
   {
      pair->Enforcement().Evaluate(displacement, pressure);
      return pair->Enforcement().UpdateActiveSet();
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

   NamedMesh mesh;
   BiphasicSpaces spaces;
   NeoHookean solid;
   ConstantPermeability fluid;
   MaterialTable materials;
   std::unique_ptr<ContactPair> pair;
   Vector u;
   Vector p;
};

real_t Norm(const Vector &x)
{
   return std::sqrt(InnerProduct(MPI_COMM_WORLD, x, x));
}

struct Balance
{
   Vector momentum;
   Vector mass;
};

Balance Forces(Bodies &bodies, const Vector &u, const Vector &p)
{
   CHECK_FALSE(bodies.Evaluate(u, p));
   Balance balance{Vector(u.Size()), Vector(p.Size())};
   balance.momentum = 0.0;
   balance.mass = 0.0;
   bodies.pair->AddForces(balance.momentum, balance.mass);
   balance.momentum.Neg();
   return balance;
}

Balance Apply(const ContactFactors &factors, const Vector &du, const Vector &dp)
{
   Balance balance{Vector(du.Size()), Vector(dp.Size())};
   Vector rows(factors.gap->Height());
   factors.gap_change->Mult(du, rows);
   rows *= *factors.gap_weights;
   factors.gap->MultTranspose(rows, balance.momentum);
   factors.force_change->Mult(1.0, du, 1.0, balance.momentum);
   factors.jump->Mult(dp, rows);
   factors.jump_change->Mult(1.0, du, 1.0, rows);
   rows *= *factors.jump_weights;
   factors.jump->MultTranspose(rows, balance.mass);
   factors.outflow_change->Mult(1.0, du, 1.0, balance.mass);
   return balance;
}
} // namespace

TEST_CASE("Factors of a pair agree with differences of its forces and flows")
{
   const int order = GENERATE(1, 2);
   const bool curved = GENERATE(false, true);
   CAPTURE(order, curved);
   Bodies bodies(order, curved);
   real_t counts[3] = {0.0, 0.0, 0.0};
   const ContactState &state = bodies.pair->State();
   for (int j = 0; j < state.traction.Size(); j++)
   {
      counts[0] += state.vertices[j].touches;
      counts[1] += state.jump_weights[j] > 0.0;
      counts[2] += bodies.pair->Coverage().area[j] > 0.0;
   }
   for (real_t &count : counts)
   {
      count = SumOverRanks(count, MPI_COMM_WORLD);
   }
   CHECK(counts[1] > 2);
   CHECK(counts[0] >= counts[1]);
   CHECK(counts[2] > counts[0] + 2);

   CHECK(bodies.pair->HasDrifted());
   CHECK(bodies.pair->Linearize(bodies.p));
   const ContactFactors factors = bodies.pair->Factors();
   CHECK_FALSE(factors.IsSymmetric());
   CHECK_FALSE(factors.IsUncoupled());
   std::vector<Balance> exact;
   std::vector<std::array<Vector, 2>> directions;
   for (int seed = 1; seed <= 3; seed++)
   {
      directions.push_back({bodies.Random(bodies.u.Size(), seed),
                            bodies.Random(bodies.p.Size(), seed + 50)});
      exact.push_back(
         Apply(factors, directions.back()[0], directions.back()[1]));
   }
   for (std::size_t i = 0; i < exact.size(); i++)
   {
      const auto moved = [&](real_t step)
      {
         Vector u(bodies.u);
         Vector p(bodies.p);
         u.Add(step, directions[i][0]);
         p.Add(step, directions[i][1]);
         return Forces(bodies, u, p);
      };
      const Balance ahead = moved(difference_step);
      const Balance behind = moved(-difference_step);
      const auto compare = [&](const char *what, const Vector &after,
                               const Vector &before, const Vector &wanted)
      {
         CAPTURE(what);
         Vector error(after);
         error -= before;
         error *= 0.5 / difference_step;
         error -= wanted;
         CHECK(Norm(wanted) > 0.0);
         CHECK(Norm(error) <= difference_tolerance * Norm(wanted));
      };
      compare("momentum", ahead.momentum, behind.momentum, exact[i].momentum);
      compare("mass", ahead.mass, behind.mass, exact[i].mass);
   }
}
