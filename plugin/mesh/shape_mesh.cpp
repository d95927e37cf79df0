#include "synovia/mesh/shape_mesh.hpp"
#include "synovia/general/error.hpp"
#include "synovia/general/text.hpp"
#include "synovia/mesh/stack_bodies.hpp"
#include "synovia/mesh/triangle_file.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

namespace synovia
{

using namespace mfem;

namespace
{
// Of a square's edge, and of a radius: curved facets miss a sphere of radius R
// by 2e-6 R then.
constexpr real_t part_of_edge = 0.25;
constexpr real_t part_of_radius = 0.125;
// Thickness of the layer, of a facet's size.
constexpr real_t thin = 0.1;

/// Three unit vectors at right angles, the third of which is the axis.
struct Axes
{
   explicit Axes(const Point3 &along)
   {
      constexpr Point3 origin{{0.0, 0.0, 0.0}};
      third = Sum(origin, 1.0 / Length(along), along);
      int across = 0;
      for (int d = 1; d < 3; d++)
      {
         if (std::abs(third[d]) < std::abs(third[across]))
         {
            across = d;
         }
      }
      Point3 unit(origin);
      unit[across] = 1.0;
      first = Sum(unit, -third[across], third);
      first = Sum(origin, 1.0 / Length(first), first);
      second = Cross(third, first);
   }

   Point3 At(const Point3 &center, real_t x, real_t y, real_t z) const
   {
      return Sum(Sum(Sum(center, x, first), y, second), z, third);
   }

   Point3 first;
   Point3 second;
   Point3 third;
};

int Cells(real_t length, real_t size)
{
   // Not one more by round-off.
   return std::max(1,
                   static_cast<int>(std::ceil(length / size * (1.0 - 1e-9))));
}

real_t FacetSize(const RigidShape &shape)
{
   if (shape.facet_size > 0.0)
   {
      return shape.facet_size;
   }
   return shape.type == RigidShape::Type::plane ? part_of_edge * shape.edge
                                                : part_of_radius * shape.radius;
}

// Facets between corners in rows.
void AddGrid(int nx, int ny, const std::function<int(int, int)> &corner,
             SurfaceSheet &sheet)
{
   for (int j = 0; j < ny; j++)
   {
      for (int i = 0; i < nx; i++)
      {
         sheet.AddQuadrilateral(corner(i, j), corner(i + 1, j),
                                corner(i + 1, j + 1), corner(i, j + 1));
      }
   }
}

Mesh MeshPlane(const RigidShape &shape)
{
   const real_t size = FacetSize(shape);
   const Axes axes(shape.axis);
   const int n = Cells(shape.edge, size);
   SurfaceSheet sheet;
   for (int j = 0; j <= n; j++)
   {
      for (int i = 0; i <= n; i++)
      {
         const real_t x = shape.edge * (real_t(i) / n - 0.5);
         const real_t y = shape.edge * (real_t(j) / n - 0.5);
         sheet.Add(axes.At(shape.center, x, y, 0.0),
                   axes.At(shape.center, x, y, -thin * size));
      }
   }
   AddGrid(
      n, n, [n](int i, int j) { return i + (n + 1) * j; }, sheet);
   return MakeLayer(sheet, 2);
}

// Nodes of order 2, moved from where they are in a mesh with plane facets.
void Curve(Mesh &mesh, const std::function<Point3(const Point3 &)> &moved)
{
   mesh.SetCurvature(2, false, 3, Ordering::byVDIM);
   const std::function<void(const Vector &, Vector &)> transformation =
      [&moved](const Vector &from, Vector &to)
   {
      const Point3 place = moved({{from[0], from[1], from[2]}});
      to.SetSize(3);
      std::copy(place.begin(), place.end(), to.begin());
   };
   VectorFunctionCoefficient coefficient(3, transformation);
   GridFunction &nodes = *mesh.GetNodes();
   GridFunction places(nodes);
   places.ProjectCoefficient(coefficient);
   nodes = places;
   // Which MFEM keeps apart.
   for (int i = 0; i < mesh.GetNV(); i++)
   {
      real_t *const vertex = mesh.GetVertex(i);
      const Point3 place = moved({{vertex[0], vertex[1], vertex[2]}});
      std::copy(place.begin(), place.end(), vertex);
   }
}

real_t Angular(real_t q)
{
   return std::tan(0.25 * M_PI * q);
}

// How far the layer's other side is from the center, of the radius.
real_t OtherSide(const RigidShape &shape, real_t size)
{
   const real_t thickness = std::min(thin * size / shape.radius, 2.0 * thin);
   return shape.hollow ? 1.0 + thickness : 1.0 - thickness;
}

// From the surface of a cube, seen from its center, with equal angles.
Mesh MeshSphere(const RigidShape &shape)
{
   const real_t size = FacetSize(shape);
   const int n = Cells(0.5 * M_PI * shape.radius, size);
   const real_t other = OtherSide(shape, size);
   SurfaceSheet sheet;
   std::map<std::array<int, 3>, int> numbers;
   for (int axis = 0; axis < 3; axis++)
   {
      for (const int side : {0, n})
      {
         const auto corner = [&](int i, int j)
         {
            std::array<int, 3> key{};
            key[axis] = side;
            key[(axis + 1) % 3] = i;
            key[(axis + 2) % 3] = j;
            const auto [entry, fresh] =
               numbers.emplace(key, static_cast<int>(numbers.size()));
            if (fresh)
            {
               Point3 place;
               for (int d = 0; d < 3; d++)
               {
                  place[d] = 2.0 * key[d] / n - 1.0;
               }
               sheet.Add(place, Sum({{0.0, 0.0, 0.0}}, other, place));
            }
            return entry->second;
         };
         const bool outward = (side == n) != shape.hollow;
         AddGrid(
            n, n,
            [&](int i, int j) { return outward ? corner(i, j) : corner(j, i); },
            sheet);
      }
   }
   Mesh mesh = MakeLayer(sheet, 2);
   Curve(mesh,
         [&shape](const Point3 &x)
         {
            const real_t m =
               std::max({std::abs(x[0]), std::abs(x[1]), std::abs(x[2])});
            const Point3 way{
               {Angular(x[0] / m), Angular(x[1] / m), Angular(x[2] / m)}};
            return Sum(shape.center, shape.radius * m / Length(way), way);
         });
   return mesh;
}

constexpr int ends = 2;

// From the sides of a square, as MeshSphere() does.
Mesh MeshCylinderSide(const RigidShape &shape)
{
   const real_t size = FacetSize(shape);
   const Axes axes(shape.axis);
   const int n = Cells(0.5 * M_PI * shape.radius, size);
   const int nz = Cells(shape.height, size);
   const real_t other = OtherSide(shape, size);
   SurfaceSheet sheet;
   for (int j = 0; j <= nz; j++)
   {
      const real_t z = shape.height * (real_t(j) / nz - 0.5);
      for (int i = 0; i < 4 * n; i++)
      {
         const real_t along = 2.0 * (i % n) / n - 1.0;
         const Point3 corners[4] = {{{1.0, along, z}},
                                    {{-along, 1.0, z}},
                                    {{-1.0, -along, z}},
                                    {{along, -1.0, z}}};
         const Point3 &place = corners[i / n];
         sheet.Add(place, {{other * place[0], other * place[1], z}});
      }
   }
   const bool outward = !shape.hollow;
   AddGrid(
      4 * n, nz,
      [n, outward](int i, int j)
      { return (outward ? i : 4 * n - i) % (4 * n) + 4 * n * j; },
      sheet);
   Mesh mesh = MakeLayer(sheet, ends + 1);
   Curve(mesh,
         [&](const Point3 &x)
         {
            const real_t m = std::max(std::abs(x[0]), std::abs(x[1]));
            const real_t a = Angular(x[0] / m);
            const real_t b = Angular(x[1] / m);
            const real_t scale = shape.radius * m / std::hypot(a, b);
            return axes.At(shape.center, scale * a, scale * b, x[2]);
         });
   return mesh;
}

// A hexagon of triangles in rings, which becomes a disk.
Mesh MeshCylinderEnd(const RigidShape &shape, bool upper)
{
   constexpr real_t sixth = M_PI / 3.0;
   const real_t size = FacetSize(shape);
   const Axes axes(shape.axis);
   const int rings = std::max(2, Cells(shape.radius, size));
   const real_t sense = upper ? 1.0 : -1.0;
   const real_t top = 0.5 * sense * shape.height;
   const real_t below = top - sense * thin * size;
   SurfaceSheet sheet;
   const auto add = [&](real_t x, real_t y) {
      sheet.Add({{x, y, top}}, {{x, y, below}});
   };
   add(0.0, 0.0);
   for (int ring = 1; ring <= rings; ring++)
   {
      for (int i = 0; i < 6 * ring; i++)
      {
         const int side = i / ring;
         const real_t from = sixth * side;
         const real_t part = real_t(i % ring) / ring;
         const real_t r = real_t(ring) / rings;
         add(
            r * ((1.0 - part) * std::cos(from) + part * std::cos(from + sixth)),
            r *
               ((1.0 - part) * std::sin(from) + part * std::sin(from + sixth)));
      }
   }
   const auto corner = [](int ring, int i)
   { return ring == 0 ? 0 : 1 + 3 * ring * (ring - 1) + i % (6 * ring); };
   const auto triangle = [&](int a, int b, int c)
   { sheet.AddTriangle(a, upper ? b : c, upper ? c : b, ends); };
   for (int ring = 1; ring <= rings; ring++)
   {
      for (int i = 0; i < 6 * ring; i++)
      {
         const int inner = i - i / ring;
         triangle(corner(ring, i), corner(ring, i + 1),
                  corner(ring - 1, inner));
         if (i % ring > 0)
         {
            triangle(corner(ring, i), corner(ring - 1, inner),
                     corner(ring - 1, inner - 1));
         }
      }
   }
   Mesh mesh = MakeLayer(sheet, ends + 1);
   Curve(mesh,
         [&](const Point3 &x)
         {
            const real_t turn = std::atan2(x[1], x[0]);
            const real_t from = sixth * std::floor(turn / sixth);
            // x is a part of the sector's first edge and one of its second.
            const real_t radius = std::hypot(x[0], x[1]);
            const real_t second =
               radius * std::sin(turn - from) / std::sin(sixth);
            const real_t first =
               radius * std::cos(turn - from) - second * std::cos(sixth);
            const real_t m = first + second;
            const real_t angle = m > 0.0 ? from + sixth * second / m : 0.0;
            return axes.At(shape.center, shape.radius * m * std::cos(angle),
                           shape.radius * m * std::sin(angle), x[2]);
         });
   return mesh;
}

// The pieces need not share nodes, as all are tied to one body.
Mesh MeshCylinder(const RigidShape &shape)
{
   Mesh side = MeshCylinderSide(shape);
   if (shape.hollow)
   {
      return side;
   }
   const Mesh upper = MeshCylinderEnd(shape, true);
   const Mesh lower = MeshCylinderEnd(shape, false);
   StackedBodies all = StackBodies({&side, &upper, &lower});
   for (int i = 0; i < all.mesh.GetNE(); i++)
   {
      all.mesh.SetAttribute(i, 1);
   }
   const int per_piece = ends + 1;
   for (int i = 0; i < all.mesh.GetNBE(); i++)
   {
      all.mesh.SetBdrAttribute(i, 1 + (all.mesh.GetBdrAttribute(i) - 1) %
                                         per_piece);
   }
   all.mesh.SetAttributes();
   return std::move(all.mesh);
}

Mesh MeshFile(const RigidShape &shape)
{
   SurfaceSheet sheet;
   try
   {
      sheet = ReadFacets(shape.file, shape.scale);
   }
   catch (const Error &error)
   {
      throw Error("\"" + shape.file + "\": " + error.what());
   }
   Thicken(sheet);
   return MakeLayer(sheet, 2);
}

void Verify(const RigidShape &shape)
{
   const auto verify = [&](const char *what, real_t value)
   {
      if (!(value > 0.0 && std::isfinite(value)))
      {
         throw Error(std::string("the ") + what + " is " + ToText(value) +
                     "; it must be positive");
      }
   };
   switch (shape.type)
   {
   case RigidShape::Type::plane:
      verify("length of the normal", Length(shape.axis));
      verify("edge", shape.edge);
      break;
   case RigidShape::Type::sphere:
      verify("radius", shape.radius);
      break;
   case RigidShape::Type::cylinder:
      verify("length of the axis", Length(shape.axis));
      verify("radius", shape.radius);
      verify("height", shape.height);
      break;
   default:
      verify("scale", shape.scale);
   }
   // More would be a slip of the pen.
   constexpr real_t most_cells = 1e3;
   const real_t extent = shape.type == RigidShape::Type::plane ? shape.edge
                         : shape.type == RigidShape::Type::cylinder
                            ? std::max(shape.radius, shape.height)
                            : shape.radius;
   if (shape.type != RigidShape::Type::file &&
       !(extent / FacetSize(shape) < most_cells))
   {
      throw Error("facets of " + ToText(FacetSize(shape)) +
                  " are too small for a shape of " + ToText(extent));
   }
}

Mesh MakeMesh(const RigidShape &shape)
{
   Verify(shape);
   switch (shape.type)
   {
   case RigidShape::Type::sphere:
      return MeshSphere(shape);
   case RigidShape::Type::cylinder:
      return MeshCylinder(shape);
   case RigidShape::Type::plane:
      return MeshPlane(shape);
   default:
      return MeshFile(shape);
   }
}
} // namespace

NamedSerialMesh MeshShape(const RigidShape &shape)
{
   MFEM_VERIFY(shape.type != RigidShape::Type::none, "there is no shape");
   try
   {
      NamedSerialMesh result{MakeMesh(shape), {{shape.name, {1}}}, {}};
      if (shape.type == RigidShape::Type::cylinder)
      {
         result.boundaries[shape.name + "_side"] = {1};
         if (!shape.hollow)
         {
            result.boundaries[shape.name + "_ends"] = {ends};
         }
         result.boundaries[shape.name + "_back"] = {ends + 1};
         result.boundaries[shape.name] =
            shape.hollow ? std::vector<int>{1} : std::vector<int>{1, 2};
      }
      else
      {
         result.boundaries[shape.name] = {1};
         if (result.mesh.bdr_attributes.Max() > 1)
         {
            result.boundaries[shape.name + "_back"] = {2};
         }
      }
      return result;
   }
   catch (const Error &error)
   {
      throw Error("the shape of \"" + shape.name + "\": " + error.what());
   }
}

NamedSerialMesh AddShapes(const Mesh &mesh, const NameTable &regions,
                          const NameTable &boundaries,
                          const std::vector<RigidShape> &shapes)
{
   std::vector<NamedSerialMesh> layers;
   std::vector<const Mesh *> all{&mesh};
   for (const RigidShape &shape : shapes)
   {
      layers.push_back(MeshShape(shape));
   }
   for (const NamedSerialMesh &layer : layers)
   {
      all.push_back(&layer.mesh);
   }
   StackedBodies stack = StackBodies(all);
   NamedSerialMesh result{std::move(stack.mesh), regions, boundaries};
   const auto enter = [](const NameTable &own, int offset, NameTable &names,
                         const std::string &kind)
   {
      for (const auto &[name, attributes] : own)
      {
         std::vector<int> moved(attributes);
         for (int &attribute : moved)
         {
            attribute += offset;
         }
         if (!names.emplace(name, moved).second)
         {
            throw Error("the shape \"" + name + "\" makes a " + kind +
                        " of a name that the mesh has already; give the body "
                        "another name");
         }
      }
   };
   for (size_t i = 0; i < layers.size(); i++)
   {
      enter(layers[i].regions, stack.region_offsets[i + 1], result.regions,
            "region");
      enter(layers[i].boundaries, stack.boundary_offsets[i + 1],
            result.boundaries, "boundary");
   }
   return result;
}

} // namespace synovia
