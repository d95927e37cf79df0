//                 Would partial assembly pay for the stiffness?
//
// Products with the stiffness matrix of two curved layers of hexahedra, as
// miniapps/scaling has them: assembled as Synovia does, and partially assembled
// by MFEM's integrator for isotropic elasticity. Beside them one sweep of l1
// Gauss-Seidel over the assembled matrix, a part of each multigrid cycle, which
// partial assembly has no substitute for.
//
// Times are of one product, and of all that comes before the first one; the
// slowest rank's. Both products are checked against each other.
//
// Sample runs:
//   partial_assembly
//   mpirun -np 2 partial_assembly --order 3 --size 8

#include "synovia/fem/effective_stress_integrator.hpp"
#include "synovia/general/option_range.hpp"
#include "synovia/general/reduce.hpp"
#include "synovia/io/csv_row.hpp"
#include "synovia/mesh/layers_estimate.hpp"
#include "synovia/synovia.hpp"

#include <algorithm>
#include <cmath>
#include <iostream>

using namespace mfem;
using namespace synovia;

namespace
{

constexpr real_t young = 0.5;
constexpr real_t poisson = 0.1;

struct Options
{
   int size = 12;
   int order = 2;
   int products = 20;

   bool Parse(int argc, char *argv[])
   {
      OptionsParser args(argc, argv);
      args.AddOption(&size, "-n", "--size",
                     "Cells of the lower layer along an edge.");
      args.AddOption(&order, "-o", "--order", "Order of the displacement.");
      args.AddOption(&products, "-p", "--products",
                     "How many products to take the mean of.");
      if (!ParseCommandLine(args))
      {
         return false;
      }
      VerifyAtLeast("--size", size, 1);
      VerifyFrom("--order", order, 1, 8);
      VerifyAtLeast("--products", products, 1);
      return true;
   }

   LayersOptions Layers() const
   {
      LayersOptions layers;
      layers.lower_cells = size;
      layers.upper_cells = static_cast<int>((3LL * size + 2) / 4);
      return layers;
   }
};

template <typename Work>
real_t Seconds(Work work)
{
   MPI_Barrier(MPI_COMM_WORLD);
   StopWatch watch;
   watch.Start();
   work();
   return MaxOverRanks(watch.RealTime(), MPI_COMM_WORLD);
}

/// Mean over several products.
real_t ProductSeconds(const Operator &matrix, const Vector &x, Vector &y,
                      int products)
{
   matrix.Mult(x, y);
   const real_t all = Seconds(
      [&]
      {
         for (int i = 0; i < products; i++)
         {
            matrix.Mult(x, y);
         }
      });
   return all / products;
}

real_t Norm(const Vector &x)
{
   return std::sqrt(InnerProduct(MPI_COMM_WORLD, x, x));
}

int Run(int argc, char *argv[])
{
   Options options;
   if (!options.Parse(argc, argv))
   {
      return 0;
   }
   VerifySize(EstimateLayers(options.Layers(), options.order), MPI_COMM_WORLD);
   NamedMesh mesh = MakeCurvedLayers(options.Layers(), MPI_COMM_WORLD);
   const H1_FECollection elements(options.order, 3);
   // Partial assembly asks for this ordering.
   ParFiniteElementSpace space(&mesh.Get(), &elements, 3, Ordering::byNODES);

   const IsotropicElastic solid(young, poisson);
   const ConstantPermeability permeability(1e-3);
   MaterialTable materials;
   for (const char *region : {"lower", "upper"})
   {
      materials.Set(mesh.Region(region), {&solid, &permeability, 0.2});
   }
   ConstantCoefficient lambda(young * poisson /
                              ((1.0 + poisson) * (1.0 - 2.0 * poisson)));
   ConstantCoefficient mu(solid.ShearModulus());

   ParBilinearForm whole(&space);
   whole.AddDomainIntegrator(new EffectiveStressIntegrator(materials));
   std::unique_ptr<HypreParMatrix> assembled;
   const real_t whole_setup = Seconds(
      [&]
      {
         whole.Assemble();
         whole.Finalize();
         assembled.reset(whole.ParallelAssemble());
      });

   ParBilinearForm partial(&space);
   partial.SetAssemblyLevel(AssemblyLevel::PARTIAL);
   auto *integrator = new ElasticityIntegrator(lambda, mu);
   // As many points as the assembled one takes.
   integrator->SetIntRule(
      &IntRules.Get(Geometry::CUBE, 2 * std::max(options.order, 2) + 1));
   partial.AddDomainIntegrator(integrator);
   OperatorHandle matrix_free;
   const real_t partial_setup = Seconds(
      [&]
      {
         partial.Assemble();
         partial.FormSystemMatrix(Array<int>(), matrix_free);
      });

   Vector x(space.GetTrueVSize());
   x.Randomize(1);
   Vector y(x.Size());
   Vector z(x.Size());
   CsvRow row;
   row.Add("order", options.order);
   row.Add("cells", mesh.Get().GetGlobalNE());
   row.Add("dofs", space.GlobalTrueVSize());
   row.Add("ranks", mesh.Get().GetNRanks());
   row.Add("setup_assembled", whole_setup);
   row.Add("setup_partial", partial_setup);
   row.Add("product_assembled",
           ProductSeconds(*assembled, x, y, options.products));
   row.Add("product_partial",
           ProductSeconds(*matrix_free, x, z, options.products));
   z -= y;
   row.Add("difference", Norm(z) / Norm(y));
   HypreSmoother smoother(*assembled, HypreSmoother::l1GS, 1);
   row.Add("sweep", ProductSeconds(smoother, y, z, options.products));
   if (Mpi::Root())
   {
      row.Print(std::cout);
   }
   return 0;
}

} // namespace

int main(int argc, char *argv[])
{
   Mpi::Init(argc, argv);
   Hypre::Init();
   return RunMain("partial_assembly", Run, argc, argv);
}
