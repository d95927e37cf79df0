#include "synovia/fem/local_matrix.hpp"

#include <algorithm>

namespace synovia
{

using namespace mfem;

Sparsity::Sparsity(const FiniteElementSpace &row_space,
                   const FiniteElementSpace &column_space)
{
   for (const FiniteElementSpace *space : {&row_space, &column_space})
   {
      MFEM_VERIFY(space->GetVDim() == 1 ||
                     space->GetOrdering() == Ordering::byVDIM,
                  "components of a node should follow each other");
   }
   Table dof_elements;
   Transpose(row_space.GetElementToDofTable(), dof_elements,
             row_space.GetNDofs());
   Table neighbors;
   mfem::Mult(dof_elements, column_space.GetElementToDofTable(), neighbors);
   neighbors.SortRows();

   const int row_dim = row_space.GetVDim();
   const int column_dim = column_space.GetVDim();
   begins.reserve(row_space.GetVSize() + 1);
   columns.reserve(static_cast<std::size_t>(row_dim) * column_dim *
                   neighbors.Size_of_connections());
   for (int dof = 0; dof < row_space.GetNDofs(); dof++)
   {
      for (int row = 0; row < row_dim; row++)
      {
         begins.push_back(static_cast<int>(columns.size()));
         for (int k = 0; k < neighbors.RowSize(dof); k++)
         {
            for (int d = 0; d < column_dim; d++)
            {
               columns.push_back(column_dim * neighbors.GetRow(dof)[k] + d);
            }
         }
      }
   }
   begins.push_back(static_cast<int>(columns.size()));
}

LocalMatrix::LocalMatrix(ParFiniteElementSpace &row_space_,
                         ParFiniteElementSpace &column_space_)
   : row_space(row_space_), column_space(column_space_),
     diagonal_first(&row_space == &column_space),
     sparsity(row_space, column_space)
{
   FindPlaces();
   if (diagonal_first)
   {
      PutDiagonalFirst();
   }
   Clear();
   if (row_space.GetNRanks() > 1 && row_space.Conforming() &&
       column_space.Conforming())
   {
      shared_sum =
         std::make_unique<SharedSum>(row_space, column_space, *matrix);
   }
}

void LocalMatrix::FindPlaces()
{
   const int row_dim = row_space.GetVDim();
   const int column_dim = column_space.GetVDim();
   const int *const begins = sparsity.Begins();
   const int *const columns = sparsity.Columns();
   const auto place_of = [&](int row_dof, int column_dof)
   {
      const int *const first = columns + begins[row_dim * row_dof];
      const int *const last = columns + begins[row_dim * row_dof + 1];
      const int *const found =
         std::lower_bound(first, last, column_dim * column_dof);
      return static_cast<int>(found - first) / column_dim;
   };
   const Table &row_dofs = row_space.GetElementToDofTable();
   const Table &column_dofs = column_space.GetElementToDofTable();
   place_begins.push_back(0);
   for (int e = 0; e < row_dofs.Size(); e++)
   {
      for (int i = 0; i < row_dofs.RowSize(e); i++)
      {
         for (int j = 0; j < column_dofs.RowSize(e); j++)
         {
            const int place =
               place_of(row_dofs.GetRow(e)[i], column_dofs.GetRow(e)[j]);
            MFEM_VERIFY(place <= UINT16_MAX,
                        "a node has more than 65536 neighbors");
            places.push_back(static_cast<std::uint16_t>(place));
         }
      }
      place_begins.push_back(places.size());
   }
   for (int dof = 0; diagonal_first && dof < row_space.GetNDofs(); dof++)
   {
      own_places.push_back(place_of(dof, dof));
   }
}

void LocalMatrix::Clear()
{
   if (constant_part.empty())
   {
      entries.assign(sparsity.Entries(), 0.0);
   }
   else
   {
      entries.assign(constant_part.begin(), constant_part.end());
   }
   matrix = std::make_unique<SparseMatrix>(
      sparsity.Begins(), sparsity.Columns(), entries.data(),
      row_space.GetVSize(), column_space.GetVSize(), false, false, false);
}

void LocalMatrix::PutDiagonalFirst()
{
   const int dim = row_space.GetVDim();
   for (int row = 0; row < row_space.GetVSize(); row++)
   {
      int *const columns = sparsity.Columns() + sparsity.Begins()[row];
      std::swap(columns[0], columns[dim * own_places[row / dim] + row % dim]);
   }
}

void LocalMatrix::Add(int element, const DenseMatrix &element_entries)
{
   const int row_dim = row_space.GetVDim();
   const int column_dim = column_space.GetVDim();
   const Table &row_dofs = row_space.GetElementToDofTable();
   const int *const dofs = row_dofs.GetRow(element);
   const int height = row_dofs.RowSize(element);
   const int width = column_space.GetElementToDofTable().RowSize(element);
   for (int i = 0; i < height; i++)
   {
      const std::uint16_t *const columns =
         places.data() + place_begins[element] + std::size_t(i) * width;
      for (int a = 0; a < row_dim; a++)
      {
         const int row = row_dim * dofs[i] + a;
         real_t *const sums = entries.data() + sparsity.Begins()[row];
         real_t *const diagonal =
            diagonal_first ? sums + row_dim * own_places[dofs[i]] + a : sums;
         // In order while they are added to.
         std::swap(sums[0], *diagonal);
         for (int b = 0; b < column_dim; b++)
         {
            const real_t *entry =
               element_entries.GetColumn(b * width) + a * height + i;
            for (int j = 0; j < width; j++)
            {
               sums[column_dim * columns[j] + b] += *entry;
               entry += row_dim * height;
            }
         }
         std::swap(sums[0], *diagonal);
      }
   }
}

std::unique_ptr<HypreParMatrix> LocalMatrix::Sum()
{
   std::unique_ptr<HypreParMatrix> sum =
      shared_sum ? shared_sum->Sum(std::move(entries))
                 : SumShared(row_space, column_space, *matrix);
   matrix.reset();
   entries = std::vector<real_t>();
   return sum;
}

} // namespace synovia
