#include "synovia/fem/volume_matrices.hpp"
#include "synovia/fem/effective_stress_integrator.hpp"
#include "synovia/fem/local_matrix.hpp"
#include "synovia/fem/pressure_projection_integrator.hpp"
#include "synovia/fem/quadrature_order.hpp"
#include "synovia/fem/shared_sum.hpp"

namespace synovia
{

using namespace mfem;

namespace
{
// MFEM by itself collects entries in linked lists, which takes twice the memory
// and a sixth more time.
std::unique_ptr<HypreParMatrix> Assemble(ParFiniteElementSpace &space,
                                         Sparsity &sparsity,
                                         BilinearFormIntegrator *integrator)
{
   ParBilinearForm form(&space);
   form.AddDomainIntegrator(integrator);
   form.UseSparsity(sparsity.Begins(), sparsity.Columns(), true);
   form.Assemble();
   form.Finalize();
   return SumShared(space, space, form.SpMat());
}

// 1 for each attribute whose material has fluid.
Array<int> WetMarker(const ParMesh &mesh, const MaterialTable &materials)
{
   Array<int> marker(mesh.attributes.Max());
   marker = 0;
   for (const int attribute : materials.WithFluid(mesh.attributes))
   {
      marker[attribute - 1] = 1;
   }
   return marker;
}
} // namespace

VolumeMatrices::VolumeMatrices(BiphasicSpaces &spaces,
                               const MaterialTable &materials)
{
   PermeabilityCoefficient permeability(materials);
   ComplianceCoefficient drained_compliance(materials);

   {
      Sparsity sparsity(spaces.Displacement(), spaces.Displacement());
      stiffness = Assemble(spaces.Displacement(), sparsity,
                           new EffectiveStressIntegrator(materials));
   }
   Sparsity sparsity(spaces.Pressure(), spaces.Pressure());
   darcy = Assemble(spaces.Pressure(), sparsity,
                    new WithFewerPoints<DiffusionIntegrator>(permeability));
   if (materials.HasSupply())
   {
      SupplyCoefficient supply(materials, [](const FluidSupply &vessels)
                               { return vessels.kp; });
      const std::unique_ptr<HypreParMatrix> held_back =
         Assemble(spaces.Pressure(), sparsity,
                  new WithFewerPoints<MassIntegrator>(supply));
      darcy.reset(Add(1.0, *darcy, 1.0, *held_back));
   }
   compliance =
      Assemble(spaces.Pressure(), sparsity,
               new WithFewerPoints<MassIntegrator>(drained_compliance));
   if (spaces.Stabilized())
   {
      stabilization = Assemble(
         spaces.Pressure(), sparsity,
         new PressureProjectionIntegrator(materials, spaces.Stabilization()));
   }
   ParMixedBilinearForm form(&spaces.Displacement(), &spaces.Pressure());
   Array<int> wet = WetMarker(spaces.GetMesh(), materials);
   form.AddDomainIntegrator(new WithFewerPoints<VectorDivergenceIntegrator>,
                            wet);
   form.Assemble();
   form.Finalize();
   divergence.reset(form.ParallelAssemble());
   divergence_transpose.reset(divergence->Transpose());
   moduli = FindModuliRatios(spaces.GetMesh(), materials);
   constexpr real_t isotropic = 1.01;
   if (moduli.anisotropy > isotropic)
   {
      anisotropy = FindAnisotropy(spaces, materials);
   }
   // The first bit of MeshGenerator() says so, on all ranks the same.
   order = spaces.Order();
   tetrahedra = (spaces.GetMesh().MeshGenerator() & 1) != 0;
}

} // namespace synovia
