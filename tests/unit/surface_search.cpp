// ranks: 1 2 3 4 16
// timeout: 300
//
// Points that look for a surface find it where geometry says, however the
// elements behind it are split over the ranks.

#include "synovia/contact/surface_search.hpp"
#include "support/boxes.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>

using namespace mfem;
using namespace synovia;

namespace
{
constexpr real_t exact = 1e-12;
const Point3 up{{0.0, 0.0, 1.0}};
const Point3 down{{0.0, 0.0, -1.0}};

enum class Split
{
   // By METIS.
   any,
   // The first rank has the lower body, the last one the upper.
   by_body,
   // The last rank has everything but one element for each other rank.
   lopsided,
   // Element i belongs to rank i modulo the number of ranks.
   scattered
};

// Two unit boxes of 3 x 3 x 1 and 4 x 4 x 1 cells with a gap of 0.1; perhaps
// bent in x.
Mesh MakeBodies(Element::Type type, bool curved)
{
   BoxOptions lower;
   lower.nx = 3;
   lower.ny = 3;
   lower.nz = 1;
   lower.type = type;
   BoxOptions upper = lower;
   upper.nx = 4;
   upper.ny = 4;
   Mesh mesh = MakeStackMesh(lower, upper);
   for (int i = MakeBoxMesh(lower).GetNV(); i < mesh.GetNV(); i++)
   {
      mesh.GetVertex(i)[2] += 0.1;
   }
   if (curved)
   {
      mesh.SetCurvature(2);
      mesh.Transform(
         [](const Vector &x, Vector &y)
         {
            y = x;
            y[2] += 0.3 * x[0] * x[0];
         });
   }
   return mesh;
}

std::vector<int> Partition(Mesh &mesh, Split split, int ranks)
{
   std::vector<int> owners(mesh.GetNE());
   for (int i = 0; i < mesh.GetNE(); i++)
   {
      if (split == Split::by_body)
      {
         owners[i] = mesh.GetAttribute(i) == 1 ? 0 : ranks - 1;
      }
      else if (split == Split::lopsided)
      {
         owners[i] = std::min(i, ranks - 1);
      }
      else
      {
         owners[i] = i % ranks;
      }
   }
   if (split == Split::by_body)
   {
      // The ranks in between get an element each of the lower body, whose
      // surface is not searched. Where they are many, some have none; MFEM's
      // curved meshes must have some on all ranks.
      for (int rank = 1; rank < ranks - 1; rank++)
      {
         if (mesh.GetAttribute(rank) == 1 || mesh.GetNodes())
         {
            owners[rank] = rank;
         }
      }
   }
   return owners;
}

class Bodies
{
public:
   Bodies(Element::Type type, bool curved, Split split, int order = 2,
          MPI_Comm comm = MPI_COMM_WORLD)
      : mesh(Make(type, curved, split, comm)), spaces(mesh.Get(), order),
        upper(spaces, mesh.Boundary("upper_z0")),
        lower(spaces, mesh.Boundary("lower_z1"))
   {
   }

   NamedMesh mesh;
   BiphasicSpaces spaces;
   ContactSurface upper;
   ContactSurface lower;

private:
   static NamedMesh Make(Element::Type type, bool curved, Split split,
                         MPI_Comm comm)
   {
      Mesh serial = MakeBodies(type, curved);
      int ranks = 1;
      MPI_Comm_size(comm, &ranks);
      const std::vector<int> owners = Partition(serial, split, ranks);
      return DistributeStack(serial, comm,
                             split == Split::any ? nullptr : owners.data());
   }
};

Bodies MakeBodies(bool curved)
{
   const auto type = GENERATE(Element::HEXAHEDRON, Element::TETRAHEDRON);
   const auto split =
      GENERATE(Split::any, Split::by_body, Split::lopsided, Split::scattered);
   UNSCOPED_INFO("element " << static_cast<int>(type) << ", split "
                            << static_cast<int>(split));
   return Bodies(type, curved, split);
}

// A grid over the interior and the rim of the unit square, in which some points
// are vertices, some on edges, and some in faces of the upper body.
std::vector<Point3> Grid(real_t z)
{
   std::vector<Point3> points;
   for (int i = 0; i <= 24; i++)
   {
      for (int j = 0; j <= 24; j++)
      {
         points.push_back({i / 24.0, j / 24.0, z});
      }
   }
   return points;
}

std::vector<SearchQuery> Look(const std::vector<Point3> &points,
                              const Point3 &normal)
{
   std::vector<SearchQuery> queries;
   for (const Point3 &point : points)
   {
      queries.push_back({point, normal});
   }
   return queries;
}

// What this rank asks: all, a share, or nothing.
std::vector<SearchQuery> MyShare(const std::vector<SearchQuery> &all)
{
   const int share = GENERATE(0, 1, 2);
   std::vector<SearchQuery> mine;
   for (size_t i = 0; i < all.size(); i++)
   {
      const int owner = static_cast<int>(i) % Mpi::WorldSize();
      if (share == 0 || (share == 1 && owner == Mpi::WorldRank()) ||
          (share == 2 && Mpi::Root()))
      {
         mine.push_back(all[i]);
      }
   }
   return mine;
}

real_t Distance(const Point3 &a, const Point3 &b)
{
   const Point3 difference = Sum(a, -1.0, b);
   return Length(difference);
}
} // namespace

TEST_CASE("A flat surface is hit exactly, on edges and vertices too")
{
   const Bodies bodies = MakeBodies(false);
   const SurfaceSearch search(bodies.upper, 0.5);
   const real_t z = GENERATE(0.7, 1.1, 1.3);
   const std::vector<SearchQuery> queries = MyShare(Look(Grid(z), up));
   const std::vector<SearchHit> hits = search.Find(queries);
   REQUIRE(hits.size() == queries.size());
   for (size_t i = 0; i < hits.size(); i++)
   {
      const Point3 &p = queries[i].point;
      CAPTURE(p[0], p[1], p[2]);
      REQUIRE(hits[i].Found());
      CHECK(std::abs(hits[i].distance - (1.1 - z)) <= exact);
      CHECK(Distance(hits[i].reference, {{p[0], p[1], 1.1}}) <= exact);
   }
}

TEST_CASE("A curved surface is hit exactly, along any normal")
{
   const Bodies bodies = MakeBodies(true);
   const SurfaceSearch search(bodies.upper, 1.0);
   const real_t slant = GENERATE(0.0, 0.4, -0.3);
   const real_t length = std::sqrt(1.0 + slant * slant);
   const Point3 normal{{slant / length, 0.0, 1.0 / length}};
   std::vector<SearchQuery> all;
   for (const Point3 &hit : Grid(0.0))
   {
      // From where on the surface to where it is seen.
      const Point3 on{{hit[0], hit[1], 1.1 + 0.3 * hit[0] * hit[0]}};
      all.push_back({Sum(on, -0.2, normal), normal});
   }
   const std::vector<SearchQuery> queries = MyShare(all);
   const std::vector<SearchHit> hits = search.Find(queries);
   REQUIRE(hits.size() == queries.size());
   for (size_t i = 0; i < hits.size(); i++)
   {
      const Point3 on = Sum(queries[i].point, 0.2, normal);
      CAPTURE(slant, on[0], on[1], on[2]);
      REQUIRE(hits[i].Found());
      CHECK(std::abs(hits[i].distance - 0.2) <= exact);
      CHECK(Distance(hits[i].reference, on) <= exact);
   }
}

TEST_CASE("Every quadrature point between surfaces finds its partner")
{
   Bodies bodies = MakeBodies(true);
   const SurfaceSearch search(bodies.upper, 0.5);
   // The surfaces are parallel in z, not along their normals: near the far end
   // those point past the upper body.
   std::vector<SearchQuery> queries;
   for (const DeformedFace &face : bodies.lower.Faces())
   {
      const IntegrationRule &rule = IntRules.Get(face.GetGeometry(), 10);
      for (int q = 0; q < rule.GetNPoints(); q++)
      {
         const IntegrationPoint &ip = rule.IntPoint(q);
         queries.push_back(
            {face.Current(ip).position, face.Reference(ip).UnitNormal()});
      }
   }
   const std::vector<SearchHit> hits = search.Find(queries);
   int found = 0;
   int wanted = 0;
   for (size_t i = 0; i < queries.size(); i++)
   {
      const Point3 &p = queries[i].point;
      const Point3 &n = queries[i].normal;
      // Where x + s n has the height 1.1 + 0.3 (x + s n_x)^2.
      real_t s = 0.0;
      for (int k = 0; k < 50; k++)
      {
         const real_t x = p[0] + s * n[0];
         const real_t f = p[2] + s * n[2] - 1.1 - 0.3 * x * x;
         s -= f / (n[2] - 0.6 * x * n[0]);
      }
      const bool hits_it = p[0] + s * n[0] >= 0.0;
      wanted += hits_it;
      found += hits[i].Found();
      CHECK(hits[i].Found() == hits_it);
      if (hits[i].Found())
      {
         CHECK(std::abs(hits[i].distance - s) <= exact);
      }
   }
   int counts[2] = {found, wanted};
   MPI_Allreduce(MPI_IN_PLACE, counts, 2, MPI_INT, MPI_SUM, MPI_COMM_WORLD);
   CHECK(counts[0] == counts[1]);
   CHECK(counts[1] > 100);
}

TEST_CASE("What is beyond the radius is not found")
{
   const Bodies bodies = MakeBodies(false);
   const SurfaceSearch search(bodies.upper, 0.3);
   const std::vector<Point3> points = {{{0.4, 0.3, 0.81}}, // 0.29 below
                                       {{0.4, 0.3, 0.79}}, // 0.31 below
                                       {{0.4, 0.3, 1.39}}, // inside the body
                                       {{0.4, 0.3, 1.41}},
                                       {{1.01, 0.3, 1.0}}, // beside it
                                       {{-0.01, 0.3, 1.0}}};
   const std::vector<SearchHit> hits = search.Find(Look(points, up));
   CHECK(hits[0].Found());
   CHECK_FALSE(hits[1].Found());
   CHECK(hits[2].Found());
   CHECK(hits[2].distance == Approx(-0.29));
   CHECK_FALSE(hits[3].Found());
   CHECK_FALSE(hits[4].Found());
   CHECK_FALSE(hits[5].Found());
}

TEST_CASE("Only faces that look back are found")
{
   const Bodies bodies = MakeBodies(false);
   const SurfaceSearch search(bodies.upper, 0.5);
   const std::vector<Point3> points = {{{0.4, 0.3, 1.0}}, {{0.4, 0.3, 1.2}}};
   // The surface looks down.
   for (const SearchHit &hit : search.Find(Look(points, down)))
   {
      CHECK_FALSE(hit.Found());
   }
   for (const SearchHit &hit : search.Find(Look(points, up)))
   {
      CHECK(hit.Found());
   }
   // Along the surface, nearly so, and 45 degrees.
   const real_t c = std::sqrt(0.5);
   const std::vector<SearchQuery> queries = {
      {{{0.4, 0.3, 1.1}}, {{1.0, 0.0, 0.0}}},
      {{{0.4, 0.3, 1.08}}, {{std::sqrt(0.99), 0.0, 0.1}}},
      {{{0.4, 0.3, 1.08}}, {{c, 0.0, c}}}};
   const std::vector<SearchHit> hits = search.Find(queries);
   CHECK_FALSE(hits[0].Found());
   CHECK_FALSE(hits[1].Found());
   REQUIRE(hits[2].Found());
   CHECK(hits[2].distance == Approx(0.02 / c));
}

TEST_CASE("Of two faces in reach the nearer one is taken")
{
   Bodies bodies = MakeBodies(false);
   // Both surfaces as one source: the lower one looks up, the upper one down.
   Array<int> both(bodies.mesh.Boundary("upper_z0"));
   both.Append(bodies.mesh.Boundary("upper_z1"));
   both.Append(bodies.mesh.Boundary("lower_z0"));
   both.Sort();
   const ContactSurface source(bodies.spaces, both);
   const SurfaceSearch search(source, 2.0);
   // Looking up: the undersides at z = 0 and z = 1.1 face the point.
   const std::vector<Point3> points = {{{0.4, 0.3, 0.5}},
                                       {{0.4, 0.3, 0.6}},
                                       {{0.4, 0.3, -0.5}},
                                       {{0.4, 0.3, 2.0}}};
   const std::vector<SearchHit> hits = search.Find(Look(points, up));
   const real_t wanted[4] = {-0.5, 0.5, 0.5, -0.9};
   for (int i = 0; i < 4; i++)
   {
      REQUIRE(hits[i].Found());
      CHECK(hits[i].distance == Approx(wanted[i]));
   }
   // Looking down: only the top at z = 2.1 does.
   const std::vector<SearchHit> below = search.Find(Look(points, down));
   CHECK(below[0].distance == Approx(-1.6));
   CHECK_FALSE(below[2].Found());
}

TEST_CASE("A surface that moves is found where it is")
{
   Bodies bodies = MakeBodies(false);
   // A quarter turn about the y axis, and away.
   VectorFunctionCoefficient turn(3,
                                  [](const Vector &x, Vector &u)
                                  {
                                     u[0] = x[2] - x[0] + 5.0;
                                     u[1] = 0.0;
                                     u[2] = -x[0] - x[2];
                                  });
   ParGridFunction field(&bodies.spaces.Displacement());
   field.ProjectCoefficient(turn);
   Vector u;
   field.GetTrueDofs(u);
   bodies.upper.SetDisplacement(u);
   const SurfaceSearch search(bodies.upper, 0.5);
   // z = 1.1 has become x = 6.1, x has become -z.
   const std::vector<SearchQuery> queries = {
      {{{6.0, 0.3, -0.4}}, {{1.0, 0.0, 0.0}}}, {{{0.4, 0.3, 1.0}}, up}};
   const std::vector<SearchHit> hits = search.Find(queries);
   REQUIRE(hits[0].Found());
   CHECK(hits[0].distance == Approx(0.1));
   CHECK(Distance(hits[0].reference, {{0.4, 0.3, 1.1}}) <= exact);
   CHECK_FALSE(hits[1].Found());
}

TEST_CASE("Faces give their dofs to whoever asks")
{
   const int order = GENERATE(1, 2, 3);
   const auto split = GENERATE(Split::by_body, Split::scattered);
   CAPTURE(order, static_cast<int>(split));
   Bodies bodies(Element::HEXAHEDRON, false, split, order);
   const SurfaceSearch search(bodies.upper, 0.5);
   const std::vector<SearchQuery> queries = Look(Grid(1.0), up);
   const std::vector<SearchHit> hits = search.Find(queries);
   std::vector<std::pair<int, int>> faces;
   for (const SearchHit &hit : hits)
   {
      faces.emplace_back(hit.rank, hit.face);
   }
   const std::vector<FaceDofs> dofs = search.GetFaceDofs(faces);
   REQUIRE(dofs.size() == faces.size());

   // A field 100 x + 10 y + z at the vertices, all of them on all ranks.
   FunctionCoefficient function([](const Vector &x)
                                { return 100.0 * x[0] + 10.0 * x[1] + x[2]; });
   ParFiniteElementSpace &space = bodies.spaces.Multiplier();
   ParGridFunction field(&space);
   field.ProjectCoefficient(function);
   Vector everywhere;
   field.GetTrueDofs(everywhere);
   const SurfaceVertices &vertices = bodies.upper.Vertices();
   const Vector mine = vertices.FromTrueDofs(everywhere);
   Vector all(static_cast<int>(vertices.GlobalSize()));
   all = 0.0;
   for (int i = 0; i < mine.Size(); i++)
   {
      all[static_cast<int>(vertices.Offsets()[0]) + i] = mine[i];
   }
   MPI_Allreduce(MPI_IN_PLACE, all.GetData(), all.Size(),
                 MPITypeMap<real_t>::mpi_type, MPI_SUM, MPI_COMM_WORLD);

   const int nodes = (order + 1) * (order + 1);
   const int pressures = order == 1 ? 4 : order * order;
   for (size_t i = 0; i < dofs.size(); i++)
   {
      CHECK(dofs[i].geometry == Geometry::SQUARE);
      CHECK(static_cast<int>(dofs[i].displacement.size()) == 3 * nodes);
      CHECK(static_cast<int>(dofs[i].pressure.size()) == pressures);
      REQUIRE(dofs[i].vertices.size() == 4);
      // The face's dofs and the hit's coordinates say where the hit is.
      const real_t x = hits[i].xi;
      const real_t y = hits[i].eta;
      const real_t shape[4] = {(1 - x) * (1 - y), x * (1 - y), x * y,
                               (1 - x) * y};
      real_t value = 0.0;
      for (int k = 0; k < 4; k++)
      {
         value += shape[k] * all[static_cast<int>(dofs[i].vertices[k])];
      }
      const Point3 &p = queries[i].point;
      CHECK(value == Approx(100.0 * p[0] + 10.0 * p[1] + 1.1));
   }
}

TEST_CASE("Hits do not depend on the ranks")
{
   const auto type = GENERATE(Element::HEXAHEDRON, Element::TETRAHEDRON);
   const auto split =
      GENERATE(Split::any, Split::by_body, Split::lopsided, Split::scattered);
   const bool curved = GENERATE(false, true);
   CAPTURE(static_cast<int>(type), static_cast<int>(split), curved);
   const Bodies together(type, curved, split);
   const Bodies alone(type, curved, Split::any, 2, MPI_COMM_SELF);
   const SurfaceSearch search(together.upper, 0.6);
   const SurfaceSearch serial_search(alone.upper, 0.6);
   const Point3 slanted{{0.6, 0.0, 0.8}};
   for (const Point3 &normal : {up, slanted})
   {
      const std::vector<SearchQuery> queries = Look(Grid(1.0), normal);
      const std::vector<SearchHit> hits = search.Find(queries);
      const std::vector<SearchHit> wanted = serial_search.Find(queries);
      for (size_t i = 0; i < queries.size(); i++)
      {
         REQUIRE(hits[i].Found() == wanted[i].Found());
         CHECK(std::abs(hits[i].distance - wanted[i].distance) <= exact);
         CHECK(Distance(hits[i].reference, wanted[i].reference) <= exact);
      }
   }
}
