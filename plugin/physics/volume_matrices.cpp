#include "physics/volume_matrices.hpp"
#include "integrators/effective_stress_integrator.hpp"
#include "integrators/pressure_projection_integrator.hpp"
#include "integrators/quadrature_order.hpp"

namespace synovia
{

using namespace mfem;

namespace
{
std::unique_ptr<HypreParMatrix> Assemble(ParFiniteElementSpace &space,
                                         BilinearFormIntegrator *integrator)
{
   ParBilinearForm form(&space);
   form.AddDomainIntegrator(integrator);
   form.Assemble();
   form.Finalize();
   return std::unique_ptr<HypreParMatrix>(form.ParallelAssemble());
}
} // namespace

VolumeMatrices::VolumeMatrices(BiphasicSpaces &spaces,
                               const MaterialTable &materials)
{
   PermeabilityCoefficient permeability(materials);
   ComplianceCoefficient drained_compliance(materials);

   stiffness =
      Assemble(spaces.Displacement(), new EffectiveStressIntegrator(materials));
   darcy = Assemble(spaces.Pressure(),
                    new WithFewerPoints<DiffusionIntegrator>(permeability));
   compliance =
      Assemble(spaces.Pressure(),
               new WithFewerPoints<MassIntegrator>(drained_compliance));
   if (spaces.Stabilised())
   {
      stabilisation = Assemble(spaces.Pressure(),
                               new PressureProjectionIntegrator(materials));
   }
   ParMixedBilinearForm form(&spaces.Displacement(), &spaces.Pressure());
   form.AddDomainIntegrator(new WithFewerPoints<VectorDivergenceIntegrator>);
   form.Assemble();
   form.Finalize();
   divergence.reset(form.ParallelAssemble());
   divergence_transpose.reset(divergence->Transpose());
   moduli = FindModuliRatios(spaces.GetMesh(), materials);
   // The first bit of MeshGenerator() says so, on all ranks the same.
   tetrahedra = (spaces.GetMesh().MeshGenerator() & 1) != 0;
}

} // namespace synovia
