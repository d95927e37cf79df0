#include "synovia/io/line_sampler.hpp"
#include "synovia/general/error.hpp"
#include "synovia/general/root_rank.hpp"
#include "synovia/io/output_directory.hpp"
#include "synovia/io/output_file.hpp"

#include <cmath>
#include <iomanip>
#include <sstream>

namespace synovia
{

using namespace mfem;

namespace
{
Array<int> AttributesOf(const NamedMesh &mesh,
                        const std::vector<std::string> &regions)
{
   Array<int> attributes;
   for (const std::string &region : regions)
   {
      attributes.Append(mesh.Region(region));
   }
   return attributes;
}

std::string CsvText(const SampledTable &table)
{
   std::ostringstream text;
   for (std::size_t j = 0; j < table.columns.size(); j++)
   {
      text << (j ? "," : "") << table.columns[j];
   }
   text << '\n' << std::setprecision(12);
   for (int i = 0; i < table.values.Height(); i++)
   {
      for (int j = 0; j < table.values.Width(); j++)
      {
         text << (j ? "," : "") << table.values(i, j);
      }
      text << '\n';
   }
   return text.str();
}
} // namespace

LineSampler::LineSampler(const NamedMesh &mesh, const LineDefinition &line_)
   : comm(mesh.GetComm()), line(line_)
{
   real_t length = 0.0;
   for (int d = 0; d < 3; d++)
   {
      length = std::hypot(length, line.to[d] - line.from[d]);
   }
   if (line.points < 2 || !(length > 0.0))
   {
      throw Error("line '" + line.name +
                  "' needs two different ends and at least 2 points");
   }
   for (int i = 0; i < line.points; i++)
   {
      const real_t s = real_t(i) / (line.points - 1);
      points.emplace_back();
      for (int d = 0; d < 3; d++)
      {
         points.back()[d] = (1.0 - s) * line.from[d] + s * line.to[d];
      }
   }
   try
   {
      located =
         LocatePoints(mesh.Get(), AttributesOf(mesh, line.regions), points);
   }
   catch (const Error &error) // on all ranks alike
   {
      throw Error("line '" + line.name + "': " + error.what());
   }
}

SampledTable LineSampler::Sample(const std::vector<SampledField> &fields) const
{
   SampledTable table;
   table.columns = {"s", "x", "y", "z"};
   for (const SampledField &field : fields)
   {
      const int components = field.values->VectorDim();
      if (components != static_cast<int>(field.columns.size()))
      {
         throw Error("line '" + line.name + "': a field of " +
                     std::to_string(components) + " components is given " +
                     std::to_string(field.columns.size()) + " columns");
      }
      table.columns.insert(table.columns.end(), field.columns.begin(),
                           field.columns.end());
   }
   DenseMatrix &values = table.values;
   values.SetSize(line.points, static_cast<int>(table.columns.size()));
   values = 0.0;
   Vector value;
   for (int i = 0; i < line.points; i++)
   {
      // One rank has the point; the others add zero.
      if (located[i].element < 0)
      {
         continue;
      }
      for (int d = 0; d < 3; d++)
      {
         const real_t part = points[i][d] - line.from[d];
         values(i, 0) = std::hypot(values(i, 0), part);
         values(i, 1 + d) = points[i][d];
      }
      int column = 4;
      for (const SampledField &field : fields)
      {
         field.values->GetVectorValue(located[i].element, located[i].ip, value);
         for (int c = 0; c < value.Size(); c++)
         {
            values(i, column++) = value(c);
         }
      }
   }
   MPI_Allreduce(MPI_IN_PLACE, values.GetData(),
                 values.Height() * values.Width(), MPITypeMap<real_t>::mpi_type,
                 MPI_SUM, comm);
   return table;
}

void LineSampler::Write(const std::string &directory, real_t time,
                        const std::vector<SampledField> &fields) const
{
   const SampledTable table = Sample(fields);
   MakeOutputDirectory(directory, comm);
   std::ostringstream path;
   path << directory << '/' << line.name << "_t" << std::setprecision(10)
        << time << ".csv";
   OnRoot(comm, [&]() { ReplaceFile(path.str(), CsvText(table)); });
}

} // namespace synovia
