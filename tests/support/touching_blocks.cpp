#include "support/touching_blocks.hpp"
#include "support/boxes.hpp"
#include "support/stack_displacement.hpp"

#include <cmath>

namespace synovia
{

using namespace mfem;

namespace
{
NamedMesh MakeBlocks(bool curved)
{
   BoxOptions lower;
   lower.nx = 5;
   lower.ny = 5;
   lower.nz = 1;
   lower.type = Element::TETRAHEDRON;
   BoxOptions upper;
   upper.nx = 3;
   upper.ny = 3;
   upper.nz = 1;
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
} // namespace

TouchingBlocks::TouchingBlocks(const TouchingBlocksOptions &options)
   : mesh(MakeBlocks(options.curved)), spaces(mesh.Get(), options.order),
     lower_linear(0.5, 0.1), upper_linear(2.0, 0.3), lower_solid(0.5, 0.1),
     upper_solid(2.0, 0.3), lower_fluid(4.0e-3), upper_fluid(1.0e-3)
{
   if (options.deformation == Deformation::finite)
   {
      materials.Set(mesh.Region("lower"), {&lower_solid, &lower_fluid, 0.2});
      materials.Set(mesh.Region("upper"), {&upper_solid, &upper_fluid, 0.2});
   }
   else
   {
      materials.Set(mesh.Region("lower"), {&lower_linear, &lower_fluid, 0.2});
      materials.Set(mesh.Region("upper"), {&upper_linear, &upper_fluid, 0.2});
   }
   ContactOptions contact;
   contact.search_radius = 0.5;
   contact.overlap_limit = 1.0;
   contact.configuration = options.configuration;
   contact.friction = options.friction;
   pair = std::make_unique<ContactPair>(
      "pair", spaces, materials, mesh.Boundary("upper_z0"),
      mesh.Boundary("lower_z1"), contact, options.deformation, options.tuning);
}

Vector TouchingBlocks::Displacement(real_t slide)
{
   const auto bent = [](const Vector &x, Vector &u)
   {
      u[0] = 0.1 * x[0];
      u[1] = 0.0;
      u[2] = 0.02 * std::sin(3.0 * x[1]);
   };
   const auto tilted = [=](const Vector &x, Vector &u)
   {
      u[0] = slide + 0.05 * x[1] * x[1];
      u[1] = 0.02 * std::sin(4.0 * x[0]);
      u[2] = 0.1 * (x[0] - 0.5);
   };
   return StackDisplacement(spaces, bent, tilted);
}

void TouchingBlocks::Touch(const Vector &u, const Vector &p)
{
   AugmentedLagrangian &enforcement = pair->Enforcement();
   enforcement.Evaluate(u, p);
   enforcement.UpdateActiveSet();
   enforcement.Augment();
   enforcement.Store(0.0);
   enforcement.Evaluate(u, p);
   enforcement.UpdateActiveSet();
}

std::array<int, 3> TouchingBlocks::Counts() const
{
   std::array<int, 3> counts{{0, 0, 0}};
   const ContactState &state = pair->State();
   for (int j = 0; j < state.traction.Size(); j++)
   {
      counts[0] += state.vertices[j].touches;
      counts[1] += state.jump_weights[j] > 0.0;
      counts[2] += pair->Constraint().Coverage().area[j] > 0.0;
   }
   MPI_Allreduce(MPI_IN_PLACE, counts.data(), 3, MPI_INT, MPI_SUM,
                 mesh.GetComm());
   return counts;
}

std::array<int, 2> TouchingBlocks::Sliding() const
{
   std::array<int, 2> counts{{0, 0}};
   const ContactState &state = pair->State();
   for (int j = 0; state.rubs && j < state.traction.Size(); j++)
   {
      const bool slides = state.friction.vertices[j].slides;
      counts[0] += state.vertices[j].touches && slides;
      counts[1] += state.vertices[j].touches && !slides;
   }
   MPI_Allreduce(MPI_IN_PLACE, counts.data(), 2, MPI_INT, MPI_SUM,
                 mesh.GetComm());
   return counts;
}

Vector RandomEntries(int size, int seed)
{
   Vector x(size);
   x.Randomize(seed + 17 * Mpi::WorldRank());
   for (real_t &entry : x)
   {
      entry = 2.0 * entry - 1.0;
   }
   return x;
}

real_t NormOf(const Vector &x)
{
   return std::sqrt(InnerProduct(MPI_COMM_WORLD, x, x));
}

} // namespace synovia
