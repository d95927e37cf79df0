#include "physics/volume_matrices.hpp"
#include "general/reduce.hpp"
#include "integrators/effective_stress_integrator.hpp"
#include "integrators/pressure_projection_integrator.hpp"

#include <algorithm>

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

real_t Incompressibility(const ParMesh &mesh, const MaterialTable &materials)
{
   real_t largest = 0.0;
   for (int i = 0; i < mesh.GetNE(); i++)
   {
      const SolidLaw &solid = *materials.Get(mesh.GetAttribute(i)).solid;
      largest =
         std::max(largest, solid.AggregateModulus() / solid.ShearModulus());
   }
   return MaxOverRanks(largest, mesh.GetComm());
}
} // namespace

VolumeMatrices::VolumeMatrices(BiphasicSpaces &spaces,
                               const MaterialTable &materials)
{
   PermeabilityCoefficient permeability(materials);
   ComplianceCoefficient drained_compliance(materials);

   stiffness =
      Assemble(spaces.Displacement(), new EffectiveStressIntegrator(materials));
   darcy = Assemble(spaces.Pressure(), new DiffusionIntegrator(permeability));
   compliance =
      Assemble(spaces.Pressure(), new MassIntegrator(drained_compliance));
   if (spaces.Stabilised())
   {
      stabilisation = Assemble(spaces.Pressure(),
                               new PressureProjectionIntegrator(materials));
   }
   ParMixedBilinearForm form(&spaces.Displacement(), &spaces.Pressure());
   form.AddDomainIntegrator(new VectorDivergenceIntegrator);
   form.Assemble();
   form.Finalize();
   divergence.reset(form.ParallelAssemble());
   divergence_transpose.reset(divergence->Transpose());
   incompressibility = Incompressibility(spaces.GetMesh(), materials);
}

} // namespace synovia
