#pragma once

#include "synovia/contact/local_blocks.hpp"
#include "synovia/contact/paired_point_shapes.hpp"

namespace synovia
{

/// Entries of a derivative by the displacement: directly, and by way of the
/// vertices' normals.
class DisplacementChange
{
public:
   /// Columns of @a block are those of PairedPointShapes::Row().
   void Append(const mfem::DenseMatrix &block,
               const std::vector<HYPRE_BigInt> &rows,
               const PairedPointShapes &at)
   {
      const std::vector<HYPRE_BigInt> &other = at.SourceDofs().displacement;
      const std::vector<HYPRE_BigInt> &own = at.DestinationDofs().displacement;
      AppendBlock(1.0, block, rows, 0, other, direct);
      AppendBlock(1.0, block, rows, static_cast<int>(other.size()), own,
                  direct);
      AppendBlock(1.0, block, rows, at.DisplacementColumns(), at.NormalRows(),
                  by_normals);
   }
   /// Columns of @a block are those of the normals alone.
   void AppendByNormals(const mfem::DenseMatrix &block,
                        const std::vector<HYPRE_BigInt> &rows,
                        const PairedPointShapes &at)
   {
      AppendBlock(1.0, block, rows, 0, at.NormalRows(), by_normals);
   }

   /// Frees the entries on the way. Collective.
   std::unique_ptr<mfem::HypreParMatrix>
   Assemble(HYPRE_BigInt *row_offsets, HYPRE_BigInt rows,
            mfem::ParFiniteElementSpace &displacement,
            const SurfaceNormals &normals,
            const mfem::HypreParMatrix &normals_change)
   {
      MPI_Comm comm = displacement.GetComm();
      const auto by_displacement = AssembleTriplets(
         comm, direct, row_offsets, rows, displacement.GetTrueDofOffsets(),
         displacement.GlobalTrueVSize());
      direct = std::vector<Triplet>();
      const auto by_normal =
         AssembleTriplets(comm, by_normals, row_offsets, rows,
                          normals.RowOffsets(), normals.GlobalRows());
      by_normals = std::vector<Triplet>();
      const std::unique_ptr<mfem::HypreParMatrix> product(
         ParMult(by_normal.get(), &normals_change, true));
      return std::unique_ptr<mfem::HypreParMatrix>(
         Add(1.0, *by_displacement, 1.0, *product));
   }

private:
   std::vector<Triplet> direct;
   std::vector<Triplet> by_normals;
};

} // namespace synovia
