#include "synovia/fem/volume_matrices.hpp"
#include "synovia/fem/assembled_matrix.hpp"
#include "synovia/fem/effective_stress_integrator.hpp"
#include "synovia/fem/pressure_projection_integrator.hpp"
#include "synovia/fem/quadrature_order.hpp"

namespace synovia
{

using namespace mfem;

namespace
{
// MFEM by itself collects entries in linked lists, which takes twice the memory
// and a sixth more time.
std::unique_ptr<HypreParMatrix> Assemble(ParFiniteElementSpace &space,
                                         SpacePatterns &patterns,
                                         BilinearFormIntegrator &&integrator)
{
   AssembledMatrix matrix(space, space, patterns.Between(space, space));
   matrix.Clear();
   DenseMatrix entries;
   for (int e = 0; e < space.GetNE(); e++)
   {
      integrator.AssembleElementMatrix(
         *space.GetFE(e), *space.GetElementTransformation(e), entries);
      matrix.Add(e, entries);
   }
   return matrix.Sum();
}

// Where there is fluid.
std::unique_ptr<HypreParMatrix>
AssembleDivergence(BiphasicSpaces &spaces, const MaterialTable &materials,
                   SpacePatterns &patterns)
{
   ParFiniteElementSpace &u = spaces.Displacement();
   ParFiniteElementSpace &p = spaces.Pressure();
   AssembledMatrix matrix(p, u, patterns.Between(p, u));
   matrix.Clear();
   WithFewerPoints<VectorDivergenceIntegrator> integrator;
   DenseMatrix entries;
   for (int e = 0; e < p.GetNE(); e++)
   {
      if (materials.Get(p.GetAttribute(e)).HasFluid())
      {
         integrator.AssembleElementMatrix2(
            *u.GetFE(e), *p.GetFE(e), *u.GetElementTransformation(e), entries);
         matrix.Add(e, entries);
      }
   }
   return matrix.Sum();
}
} // namespace

VolumeMatrices::VolumeMatrices(BiphasicSpaces &spaces,
                               const MaterialTable &materials)
   : VolumeMatrices(spaces, materials, *std::make_unique<SpacePatterns>(spaces))
{
}

VolumeMatrices::VolumeMatrices(BiphasicSpaces &spaces,
                               const MaterialTable &materials,
                               SpacePatterns &patterns)
{
   PermeabilityCoefficient permeability(materials);
   ComplianceCoefficient drained_compliance(materials);

   ParFiniteElementSpace &u = spaces.Displacement();
   ParFiniteElementSpace &p = spaces.Pressure();
   stiffness = Assemble(u, patterns, EffectiveStressIntegrator(materials));
   darcy =
      Assemble(p, patterns, WithFewerPoints<DiffusionIntegrator>(permeability));
   if (materials.HasSupply())
   {
      SupplyCoefficient supply(materials, [](const FluidSupply &vessels)
                               { return vessels.kp; });
      const std::unique_ptr<HypreParMatrix> held_back =
         Assemble(p, patterns, WithFewerPoints<MassIntegrator>(supply));
      darcy.reset(Add(1.0, *darcy, 1.0, *held_back));
   }
   compliance = Assemble(p, patterns,
                         WithFewerPoints<MassIntegrator>(drained_compliance));
   if (spaces.Stabilized())
   {
      stabilization = Assemble(
         p, patterns,
         PressureProjectionIntegrator(materials, spaces.Stabilization()));
   }
   divergence = AssembleDivergence(spaces, materials, patterns);
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
