#pragma once

#include "synovia/contact/local_blocks.hpp"
#include "synovia/contact/surface_vertices.hpp"
#include "synovia/general/point3.hpp"

namespace synovia
{

/// Rows are the vertices of a destination face, columns dofs of one face.
class VertexBlock
{
public:
   VertexBlock(std::size_t rows, std::size_t columns)
      : values(static_cast<int>(rows), static_cast<int>(columns))
   {
      values = 0.0;
   }
   /// Adds weight_j x shape_k.
   void Add(const mfem::Vector &weights, const mfem::Vector &shape)
   {
      mfem::AddMultVWt(weights, shape, values);
   }
   /// Adds weight_j x shape_k x direction_d in column 3 k + d.
   void Add(const mfem::Vector &weights, const mfem::Vector &shape,
            const Point3 &direction)
   {
      for (int k = 0; k < shape.Size(); k++)
      {
         for (int d = 0; d < 3; d++)
         {
            for (int j = 0; j < weights.Size(); j++)
            {
               values(j, 3 * k + d) += weights[j] * shape[k] * direction[d];
            }
         }
      }
   }
   void AppendTo(mfem::real_t sign, const std::vector<HYPRE_BigInt> &rows,
                 const std::vector<HYPRE_BigInt> &columns,
                 std::vector<Triplet> &triplets) const
   {
      AppendBlock(sign, values, rows, 0, columns, triplets);
   }

private:
   mfem::DenseMatrix values;
};

/// A sum over the vertices around them, zero at first.
class VertexSums
{
public:
   explicit VertexSums(const SurfaceVertices &surface_)
      : surface(surface_), local(surface.LocalSize())
   {
      local = 0.0;
   }
   void Add(const mfem::Array<int> &vertices, mfem::real_t factor,
            const mfem::Vector &weights)
   {
      for (int j = 0; j < vertices.Size(); j++)
      {
         local[vertices[j]] += factor * weights[j];
      }
   }
   /// Collective.
   mfem::Vector OverRanks() const { return surface.SumShared(local); }

private:
   const SurfaceVertices &surface;
   mfem::Vector local;
};

/// Of values at the nodes of a face, or at its vertices.
inline mfem::real_t Interpolate(const mfem::Vector &shape,
                                const mfem::Array<int> &dofs,
                                const mfem::Vector &values)
{
   mfem::real_t value = 0.0;
   for (int k = 0; k < dofs.Size(); k++)
   {
      value += shape[k] * values[dofs[k]];
   }
   return value;
}

} // namespace synovia
