#include "synovia/fem/assembled_matrix.hpp"

#include <algorithm>
#include <climits>
#include <utility>

namespace synovia
{

using namespace mfem;

namespace
{
// What a matrix takes and frees.
template <typename T>
T *Stolen(Array<T> &&array)
{
   if (array.Size() == 0)
   {
      // MFEM's debug device can't free null pointers.
      return Memory<T>(1);
   }
   T *values;
   array.StealData(&values);
   return values;
}
} // namespace

void AssembledMatrix::Block::Clear()
{
   entries.SetSize(Size(), Device::GetHostMemoryType());
   if (constant_part.empty())
   {
      entries = 0.0;
   }
   else
   {
      std::copy(constant_part.begin(), constant_part.end(), entries.begin());
   }
}

AssembledMatrix::AssembledMatrix(ParFiniteElementSpace &row_space_,
                                 ParFiniteElementSpace &column_space_)
   : AssembledMatrix(row_space_, column_space_,
                     std::make_shared<NodePattern>(row_space_, column_space_))
{
}

AssembledMatrix::AssembledMatrix(ParFiniteElementSpace &row_space_,
                                 ParFiniteElementSpace &column_space_,
                                 std::shared_ptr<const NodePattern> pattern_)
   : row_space(row_space_), column_space(column_space_),
     row_dim(row_space.GetVDim()), column_dim(column_space.GetVDim()),
     pattern(std::move(pattern_)), diagonal{pattern->Diagonal(),
                                            row_dim * column_dim,
                                            {},
                                            {}},
     beside{pattern->Beside(), row_dim * column_dim, {}, {}},
     foreign{pattern->Foreign(), row_dim * column_dim, {}, {}}
{
   MFEM_VERIFY(pattern->RowNodes() == row_space.GetNDofs() &&
                  pattern->ColumnNodes() == column_space.GetNDofs(),
               "the pattern should be of spaces with the same nodes");
   for (const Block *block : {&diagonal, &beside, &foreign})
   {
      MFEM_VERIFY(block->lists.nodes.size() <
                     std::size_t(INT_MAX) / block->per_pair,
                  "a rank's matrix has more than 2^31 entries: use more ranks");
   }
}

void AssembledMatrix::Clear()
{
   for (Block *block : {&diagonal, &beside, &foreign})
   {
      block->Clear();
   }
}

void AssembledMatrix::KeepAsConstant()
{
   for (Block *block : {&diagonal, &beside, &foreign})
   {
      block->constant_part.assign(block->entries.begin(), block->entries.end());
      block->entries.DeleteAll();
   }
}

void AssembledMatrix::Add(int element, const DenseMatrix &entries)
{
   Add(element, entries, false);
}

void AssembledMatrix::AddTransposed(int element, const DenseMatrix &entries)
{
   Add(element, entries, true);
}

void AssembledMatrix::Add(const Array<int> &rows, const Array<int> &columns,
                          const DenseMatrix &entries)
{
   Add(rows, columns, entries, false);
}

void AssembledMatrix::AddTransposed(const Array<int> &rows,
                                    const Array<int> &columns,
                                    const DenseMatrix &entries)
{
   Add(rows, columns, entries, true);
}

AssembledMatrix::RowView AssembledMatrix::View(const DenseMatrix &entries,
                                               bool transposed,
                                               std::ptrdiff_t &next_row) const
{
   const std::ptrdiff_t leading = entries.Height();
   if (transposed)
   {
      next_row = leading;
      return {entries.Data(), entries.Width() / row_dim * leading,
              leading / column_dim, 1};
   }
   next_row = 1;
   return {entries.Data(), leading / row_dim,
           entries.Width() / column_dim * leading, leading};
}

void AssembledMatrix::Add(int element, const DenseMatrix &entries,
                          bool transposed)
{
   const Table &dofs = row_space.GetElementToDofTable();
   const int width = column_space.GetElementToDofTable().RowSize(element);
   const std::int16_t *places = pattern->Places(element);
   std::ptrdiff_t next_row;
   RowView view = View(entries, transposed, next_row);
   for (int i = 0; i < dofs.RowSize(element); i++)
   {
      AddRow(pattern->Row(dofs.GetRow(element)[i]), places, width, view);
      places += width;
      view.entries += next_row;
   }
}

void AssembledMatrix::Add(const Array<int> &rows, const Array<int> &columns,
                          const DenseMatrix &entries, bool transposed)
{
   const int width = columns.Size() / column_dim;
   std::vector<int> places(width);
   std::ptrdiff_t next_row;
   RowView view = View(entries, transposed, next_row);
   for (int i = 0; i < rows.Size() / row_dim; i++)
   {
      const int node = rows[i] / row_dim;
      for (int j = 0; j < width; j++)
      {
         places[j] = pattern->Place(node, columns[j] / column_dim);
      }
      AddRow(pattern->Row(node), places.data(), width, view);
      view.entries += next_row;
   }
}

template <typename Place>
void AssembledMatrix::AddRow(int row, const Place *places, int width,
                             const RowView &view)
{
   const bool mine = row >= 0;
   Block &block = mine ? diagonal : foreign;
   const int own_row = mine ? row : -1 - row;
   real_t *here = block.Row(own_row);
   const int length = column_dim * block.lists.Length(own_row);
   real_t *there = mine ? beside.Row(own_row) : nullptr;
   const int length_there =
      mine ? column_dim * beside.lists.Length(own_row) : 0;
   for (int a = 0; a < row_dim; a++)
   {
      for (int b = 0; b < column_dim; b++)
      {
         const real_t *entry =
            view.entries + a * view.row_stride + b * view.column_stride;
         for (int j = 0; j < width; j++)
         {
            const int place = places[j];
            real_t &sum = place >= 0 ? here[column_dim * place + b]
                                     : there[column_dim * (-1 - place) + b];
            sum += *entry;
            entry += view.node_stride;
         }
      }
      here += length;
      there += length_there;
   }
}

void AssembledMatrix::AddIncoming()
{
   MPI_Comm comm = row_space.GetComm();
   const MPI_Datatype type = MPITypeMap<real_t>::mpi_type;
   std::vector<MPI_Request> requests;
   std::vector<std::vector<real_t>> received;
   received.reserve(pattern->GetIncoming().size());
   for (const NodePattern::Incoming &message : pattern->GetIncoming())
   {
      received.emplace_back(message.places.nodes.size() * foreign.per_pair);
      requests.emplace_back();
      MPI_Irecv(received.back().data(),
                static_cast<int>(received.back().size()), type, message.rank, 0,
                comm, &requests.back());
   }
   int first = 0;
   for (const NodePattern::Outgoing &message : pattern->GetOutgoing())
   {
      const int end = first + message.rows;
      requests.emplace_back();
      MPI_Isend(foreign.Row(first),
                static_cast<int>(foreign.Row(end) - foreign.Row(first)), type,
                message.rank, 0, comm, &requests.back());
      first = end;
   }
   MPI_Waitall(static_cast<int>(requests.size()), requests.data(),
               MPI_STATUSES_IGNORE);
   for (std::size_t r = 0; r < received.size(); r++)
   {
      const NodePattern::Incoming &message = pattern->GetIncoming()[r];
      const real_t *entries = received[r].data();
      for (std::size_t k = 0; k < message.rows.size(); k++)
      {
         const int row = static_cast<int>(k);
         const int width = message.places.Length(row);
         AddRow(message.rows[k],
                message.places.nodes.data() + message.places.Begin(row), width,
                {entries, column_dim * width, 1, column_dim});
         entries += foreign.per_pair * width;
      }
   }
}

Array<int> AssembledMatrix::Begins(const Block &block) const
{
   const int nodes = static_cast<int>(block.lists.begins.size()) - 1;
   Array<int> begins(row_dim * nodes + 1);
   begins[0] = 0;
   for (int row = 0; row < row_dim * nodes; row++)
   {
      begins[row + 1] =
         begins[row] + column_dim * block.lists.Length(row / row_dim);
   }
   return begins;
}

Array<int> AssembledMatrix::Columns(const Block &block) const
{
   const NodePattern::Lists &lists = block.lists;
   Array<int> columns(block.Size());
   int *next = columns.GetData();
   for (int node = 0; node + 1 < static_cast<int>(lists.begins.size()); node++)
   {
      for (int a = 0; a < row_dim; a++)
      {
         for (int k = lists.Begin(node); k < lists.Begin(node + 1); k++)
         {
            for (int b = 0; b < column_dim; b++)
            {
               *next++ = column_dim * lists.nodes[k] + b;
            }
         }
      }
   }
   return columns;
}

std::unique_ptr<HypreParMatrix> AssembledMatrix::Sum()
{
   MFEM_VERIFY(diagonal.entries.Size() == diagonal.Size(),
               "the matrix should be cleared before it is added to");
   AddIncoming();
   foreign.entries.DeleteAll();
   const std::vector<HYPRE_BigInt> &nodes = pattern->BesideNumbers();
   const int size_beside = column_dim * static_cast<int>(nodes.size());
   Array<HYPRE_BigInt> numbers(size_beside);
   for (int k = 0; k < size_beside; k++)
   {
      numbers[k] = column_dim * nodes[k / column_dim] + k % column_dim;
   }
   // Which takes all arrays, and puts the diagonal's entry first in each row.
   return std::make_unique<HypreParMatrix>(
      row_space.GetComm(), row_space.GlobalTrueVSize(),
      column_space.GlobalTrueVSize(), row_space.GetTrueDofOffsets(),
      column_space.GetTrueDofOffsets(), Stolen(Begins(diagonal)),
      Stolen(Columns(diagonal)), Stolen(std::move(diagonal.entries)),
      Stolen(Begins(beside)), Stolen(Columns(beside)),
      Stolen(std::move(beside.entries)), size_beside,
      Stolen(std::move(numbers)));
}

} // namespace synovia
