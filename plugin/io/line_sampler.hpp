#pragma once

#include "synovia/io/point_locator.hpp"
#include "synovia/mesh/named_mesh.hpp"

#include <string>
#include <vector>

namespace synovia
{

/// A straight line through the undeformed bodies.
struct LineDefinition
{
   /// Names the file.
   std::string name;
   std::array<mfem::real_t, 3> from{};
   std::array<mfem::real_t, 3> to{};
   /// How many points, both ends included; at least 2.
   int points = 51;
   /// Where the points are looked for; empty stands for the whole mesh. Name a
   /// region where the line runs along the interface of two bodies.
   std::vector<std::string> regions;
};

/// A field and a column for each of its components.
struct SampledField
{
   std::vector<std::string> columns;
   const mfem::ParGridFunction *values = nullptr;
};

/// A table with a name for each column, the same on all ranks.
struct SampledTable
{
   std::vector<std::string> columns;
   mfem::DenseMatrix values; // points x columns
};

/// Samples fields along a line. The points are looked for once.
class LineSampler
{
public:
   /// Borrows @a mesh. Collective. Throws Error, with the line's name, if a
   /// region is unknown or a point is not in it, and on a line of no length or
   /// fewer than 2 points.
   LineSampler(const NamedMesh &mesh, const LineDefinition &line);

   /// Columns s (distance from the first point), x, y, z, and the columns of
   /// the fields, which live on the mesh. Collective. Throws Error if a field
   /// has another number of components than it has columns.
   SampledTable Sample(const std::vector<SampledField> &fields) const;

   /// Writes what Sample() gives to `<directory>/<name>_t<time>.csv`, making
   /// the directory where needed. Collective; rank 0 writes. Throws Error on
   /// all ranks if that fails.
   void Write(const std::string &directory, mfem::real_t time,
              const std::vector<SampledField> &fields) const;

private:
   MPI_Comm comm;
   LineDefinition line;
   std::vector<std::array<mfem::real_t, 3>> points;
   std::vector<LocatedPoint> located;
};

} // namespace synovia
