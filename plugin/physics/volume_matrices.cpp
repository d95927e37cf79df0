#include "physics/volume_matrices.hpp"
#include "integrators/effective_stress_integrator.hpp"
#include "integrators/pressure_projection_integrator.hpp"
#include "integrators/quadrature_order.hpp"

#include <vector>

namespace synovia
{

using namespace mfem;

namespace
{
// Where the matrix of a vector-valued space has entries: in rows and columns of
// dofs that share an element.
class Sparsity
{
public:
   explicit Sparsity(const FiniteElementSpace &space)
   {
      MFEM_VERIFY(space.GetVDim() == 1 ||
                     space.GetOrdering() == Ordering::byVDIM,
                  "components of a node should follow each other");
      const Table &element_dofs = space.GetElementToDofTable();
      Table dof_elements;
      Transpose(element_dofs, dof_elements, space.GetNDofs());
      Table neighbours;
      Mult(dof_elements, element_dofs, neighbours);
      neighbours.SortRows();

      const int dim = space.GetVDim();
      const int nonzeros = dim * dim * neighbours.Size_of_connections();
      begins.reserve(space.GetVSize() + 1);
      columns.reserve(nonzeros);
      for (int dof = 0; dof < space.GetNDofs(); dof++)
      {
         for (int row = 0; row < dim; row++)
         {
            begins.push_back(static_cast<int>(columns.size()));
            for (int k = 0; k < neighbours.RowSize(dof); k++)
            {
               for (int d = 0; d < dim; d++)
               {
                  columns.push_back(dim * neighbours.GetRow(dof)[k] + d);
               }
            }
         }
      }
      begins.push_back(static_cast<int>(columns.size()));
   }
   /// Outlives the form's matrix.
   void ApplyTo(BilinearForm &form)
   {
      form.UseSparsity(begins.data(), columns.data(), true);
   }

private:
   std::vector<int> begins;
   std::vector<int> columns;
};

// P^T A P of a matrix on local dofs. hypre's product of two matrices, twice,
// takes a fifth of the time of its product of three, which MFEM's
// ParallelAssemble() uses.
std::unique_ptr<HypreParMatrix> SumShared(ParFiniteElementSpace &space,
                                          SparseMatrix &local)
{
   const HypreParMatrix diagonal(space.GetComm(), space.GlobalVSize(),
                                 space.GetDofOffsets(), &local);
   const HypreParMatrix *prolongation = space.Dof_TrueDof_Matrix();
   const std::unique_ptr<HypreParMatrix> columns(
      ParMult(&diagonal, prolongation));
   const std::unique_ptr<HypreParMatrix> transpose(prolongation->Transpose());
   return std::unique_ptr<HypreParMatrix>(
      ParMult(transpose.get(), columns.get(), true));
}

// MFEM by itself collects entries in linked lists, which takes twice the memory
// and a sixth more time.
std::unique_ptr<HypreParMatrix> Assemble(ParFiniteElementSpace &space,
                                         Sparsity &sparsity,
                                         BilinearFormIntegrator *integrator)
{
   ParBilinearForm form(&space);
   form.AddDomainIntegrator(integrator);
   sparsity.ApplyTo(form);
   form.Assemble();
   form.Finalize();
   return SumShared(space, form.SpMat());
}
} // namespace

VolumeMatrices::VolumeMatrices(BiphasicSpaces &spaces,
                               const MaterialTable &materials)
{
   PermeabilityCoefficient permeability(materials);
   ComplianceCoefficient drained_compliance(materials);

   {
      Sparsity sparsity(spaces.Displacement());
      stiffness = Assemble(spaces.Displacement(), sparsity,
                           new EffectiveStressIntegrator(materials));
   }
   Sparsity sparsity(spaces.Pressure());
   darcy = Assemble(spaces.Pressure(), sparsity,
                    new WithFewerPoints<DiffusionIntegrator>(permeability));
   compliance =
      Assemble(spaces.Pressure(), sparsity,
               new WithFewerPoints<MassIntegrator>(drained_compliance));
   if (spaces.Stabilised())
   {
      stabilisation = Assemble(spaces.Pressure(), sparsity,
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
   order = spaces.Order();
   tetrahedra = (spaces.GetMesh().MeshGenerator() & 1) != 0;
}

} // namespace synovia
