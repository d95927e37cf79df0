#include "support/round_meshes.hpp"
#include "support/boxes.hpp"

#include <cmath>
#include <map>

namespace synovia
{

using namespace mfem;

namespace
{
// The meshes are made as shells of a unit cube (square), the core being the
// cube [0, 1/2]^3, and then blown up.
constexpr real_t core_end = 0.5;

/// Where a point of the unit cube (square) goes, given its first @a dim
/// coordinates.
void BlowUp(const RoundOptions &options, int dim, const Vector &from,
            Vector &to)
{
   to = from;
   real_t largest = 0.0;
   real_t length = 0.0;
   for (int d = 0; d < dim; d++)
   {
      largest = std::max(largest, from[d]);
      length = std::hypot(length, from[d]);
   }
   const real_t core = options.core_size * options.radius;
   real_t factor = core / core_end;
   if (largest > core_end)
   {
      const real_t s = (largest - core_end) / (1.0 - core_end);
      factor = (1.0 - s) * core / largest + s * options.radius / length;
   }
   for (int d = 0; d < dim; d++)
   {
      to[d] *= factor;
   }
}

/// Vertices of the shells of a unit cube or square, each of them once.
class ShellGrid
{
public:
   ShellGrid(Mesh &mesh_, const RoundOptions &options_)
      : mesh(mesh_), options(options_)
   {
   }

   /// Grid point (i, j, k) of the core, moved out by a number of shells if it
   /// is on the outside of the core.
   int Vertex(int i, int j, int k, int shell)
   {
      const std::array<int, 4> key{{i, j, k, shell}};
      const auto found = numbers.find(key);
      if (found != numbers.end())
      {
         return found->second;
      }
      const real_t in = 1.0 - static_cast<real_t>(shell) / options.shells;
      const real_t out = 1.0 - std::pow(in, options.grading);
      const real_t size = core_end + (1.0 - core_end) * out;
      const real_t step = size / options.core;
      const int number = mesh.AddVertex(i * step, j * step, k * step);
      numbers[key] = number;
      return number;
   }

private:
   Mesh &mesh;
   const RoundOptions &options;
   std::map<std::array<int, 4>, int> numbers;
};

/// Gives the boundary elements attributes: 1 + d where the coordinate d is
/// zero, and @a outside elsewhere.
void MarkBoundary(Mesh &mesh, int dim, int outside)
{
   for (int i = 0; i < mesh.GetNBE(); i++)
   {
      Array<int> vertices;
      mesh.GetBdrElementVertices(i, vertices);
      int attribute = outside;
      for (int d = 0; d < dim; d++)
      {
         real_t largest = 0.0;
         for (const int v : vertices)
         {
            largest = std::max(largest, std::abs(mesh.GetVertex(v)[d]));
         }
         if (largest == 0.0)
         {
            attribute = 1 + d;
         }
      }
      mesh.SetBdrAttribute(i, attribute);
   }
   mesh.SetAttributes();
}

void Curve(Mesh &mesh, const RoundOptions &options, int dim)
{
   mesh.SetCurvature(options.order, false, 3, Ordering::byVDIM);
   mesh.Transform([&](const Vector &from, Vector &to)
                  { BlowUp(options, dim, from, to); });
}
} // namespace

NamedMesh MakeQuarterCylinder(const RoundOptions &options)
{
   const int n = options.core;
   Mesh flat(2, 0, 0);
   ShellGrid grid(flat, options);
   for (int i = 0; i < n; i++)
   {
      for (int j = 0; j < n; j++)
      {
         flat.AddQuad(grid.Vertex(i, j, 0, 0), grid.Vertex(i + 1, j, 0, 0),
                      grid.Vertex(i + 1, j + 1, 0, 0),
                      grid.Vertex(i, j + 1, 0, 0));
      }
   }
   for (int s = 0; s < options.shells; s++)
   {
      for (int i = 0; i < n; i++)
      {
         flat.AddQuad(grid.Vertex(n, i, 0, s), grid.Vertex(n, i, 0, s + 1),
                      grid.Vertex(n, i + 1, 0, s + 1),
                      grid.Vertex(n, i + 1, 0, s));
         flat.AddQuad(grid.Vertex(i + 1, n, 0, s),
                      grid.Vertex(i + 1, n, 0, s + 1),
                      grid.Vertex(i, n, 0, s + 1), grid.Vertex(i, n, 0, s));
      }
   }
   flat.FinalizeTopology();
   flat.Finalize();
   MarkBoundary(flat, 2, 3);
   const std::unique_ptr<Mesh> mesh(
      Extrude2D(&flat, options.layers, options.height));
   // Extrusion gives the ends attributes of its own.
   for (int i = 0; i < mesh->GetNBE(); i++)
   {
      Array<int> vertices;
      mesh->GetBdrElementVertices(i, vertices);
      real_t lowest = options.height;
      real_t highest = 0.0;
      for (const int v : vertices)
      {
         lowest = std::min(lowest, mesh->GetVertex(v)[2]);
         highest = std::max(highest, mesh->GetVertex(v)[2]);
      }
      if (lowest == highest)
      {
         mesh->SetBdrAttribute(i, lowest > 0.0 ? 5 : 4);
      }
   }
   mesh->SetAttributes();
   Curve(*mesh, options, 2);
   return DistributeMesh(
      *mesh, {{"body", {1}}},
      {{"x0", {1}}, {"y0", {2}}, {"side", {3}}, {"z0", {4}}, {"z1", {5}}},
      MPI_COMM_WORLD);
}

NamedMesh MakeBallOctant(const RoundOptions &options)
{
   const int n = options.core;
   Mesh mesh(3, 0, 0);
   ShellGrid grid(mesh, options);
   // A quadrilateral, whose normal points away from the center, and the one
   // outside of it.
   const auto add_hex =
      [&](const std::array<std::array<int, 3>, 4> &corners, int shell)
   {
      int vertices[8];
      for (int c = 0; c < 4; c++)
      {
         const auto [i, j, k] = corners[c];
         vertices[c] = grid.Vertex(i, j, k, shell);
         vertices[c + 4] = grid.Vertex(i, j, k, shell + 1);
      }
      mesh.AddHex(vertices);
   };
   for (int i = 0; i < n; i++)
   {
      for (int j = 0; j < n; j++)
      {
         for (int k = 0; k < n; k++)
         {
            mesh.AddHex(
               grid.Vertex(i, j, k, 0), grid.Vertex(i + 1, j, k, 0),
               grid.Vertex(i + 1, j + 1, k, 0), grid.Vertex(i, j + 1, k, 0),
               grid.Vertex(i, j, k + 1, 0), grid.Vertex(i + 1, j, k + 1, 0),
               grid.Vertex(i + 1, j + 1, k + 1, 0),
               grid.Vertex(i, j + 1, k + 1, 0));
         }
         for (int s = 0; s < options.shells; s++)
         {
            add_hex(
               {{{n, i, j}, {n, i + 1, j}, {n, i + 1, j + 1}, {n, i, j + 1}}},
               s);
            add_hex(
               {{{j, n, i}, {j, n, i + 1}, {j + 1, n, i + 1}, {j + 1, n, i}}},
               s);
            add_hex(
               {{{i, j, n}, {i + 1, j, n}, {i + 1, j + 1, n}, {i, j + 1, n}}},
               s);
         }
      }
   }
   mesh.FinalizeTopology();
   mesh.Finalize();
   MarkBoundary(mesh, 3, 4);
   Curve(mesh, options, 3);
   return DistributeMesh(
      mesh, {{"body", {1}}},
      {{"x0", {1}}, {"y0", {2}}, {"z0", {3}}, {"surface", {4}}},
      MPI_COMM_WORLD);
}

NamedMesh MakeQuarterRing(const RingOptions &options)
{
   BoxOptions box;
   box.nx = options.around;
   box.ny = 1;
   box.nz = options.across;
   box.grading = options.grading;
   Mesh mesh = MakeBoxMesh(box);
   mesh.SetCurvature(options.order);
   mesh.Transform(
      [&options](const Vector &x, Vector &y)
      {
         const real_t angle = 0.5 * M_PI * x[0];
         const real_t r =
            options.inner + (options.outer - options.inner) * x[2];
         y[0] = r * std::cos(angle);
         y[1] = r * std::sin(angle);
         y[2] = options.height * x[1];
      });
   // Of the box z0, y0, x1, y1, x0 and z1.
   return DistributeMesh(mesh, {{"body", {1}}},
                         {{"inside", {1}},
                          {"z0", {2}},
                          {"x0", {3}},
                          {"z1", {4}},
                          {"y0", {5}},
                          {"outside", {6}}},
                         MPI_COMM_WORLD);
}

} // namespace synovia
