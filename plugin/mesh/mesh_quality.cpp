#include "synovia/mesh/mesh_quality.hpp"
#include "synovia/general/reduce.hpp"
#include "synovia/mesh/jacobian_samples.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <vector>

namespace synovia
{

using namespace mfem;

namespace
{

// A corner of a reference element, the directions of its three edges, and what
// makes 1 of a regular element.
struct Corner
{
   IntegrationPoint point;
   DenseMatrix edges;
   real_t scale;
};

// The other ends of the edges at each corner, in right-handed order. The apex
// of a pyramid has four edges and no Jacobian, and is left out.
std::vector<std::vector<int>> EdgesAtCorners(Geometry::Type geometry)
{
   switch (geometry)
   {
   case Geometry::TETRAHEDRON:
      return {{1, 2, 3}, {2, 0, 3}, {0, 1, 3}, {0, 2, 1}};
   case Geometry::CUBE:
      return {{1, 3, 4}, {2, 0, 5}, {3, 1, 6}, {0, 2, 7},
              {7, 5, 0}, {4, 6, 1}, {5, 7, 2}, {6, 4, 3}};
   case Geometry::PRISM:
      return {{1, 2, 3}, {2, 0, 4}, {0, 1, 5}, {5, 4, 0}, {3, 5, 1}, {4, 3, 2}};
   case Geometry::PYRAMID:
      return {{1, 3, 4}, {2, 0, 4}, {3, 1, 4}, {0, 2, 4}};
   default:
      MFEM_ABORT("no volume element: geometry " << geometry);
   }
}

// The regular pyramid has a square base and edges of one length.
real_t RegularScale(Geometry::Type geometry)
{
   return geometry == Geometry::CUBE    ? 1.0
          : geometry == Geometry::PRISM ? 2.0 / std::sqrt(3.0)
                                        : std::sqrt(2.0);
}

std::vector<Corner> Corners(Geometry::Type geometry)
{
   const auto edges = EdgesAtCorners(geometry);
   const IntegrationRule &points = *Geometries.GetVertices(geometry);
   std::vector<Corner> corners;
   for (size_t i = 0; i < edges.size(); i++)
   {
      const IntegrationPoint &from = points.IntPoint(static_cast<int>(i));
      Corner corner{from, DenseMatrix(3), RegularScale(geometry)};
      for (int j = 0; j < 3; j++)
      {
         const IntegrationPoint &to = points.IntPoint(edges[i][j]);
         corner.edges(0, j) = to.x - from.x;
         corner.edges(1, j) = to.y - from.y;
         corner.edges(2, j) = to.z - from.z;
      }
      corners.push_back(corner);
   }
   return corners;
}

real_t ScaledJacobianFrom(const DenseMatrix &jacobian, const Corner &corner)
{
   DenseMatrix tangents(3);
   Mult(jacobian, corner.edges, tangents);
   real_t lengths = 1.0;
   for (int j = 0; j < 3; j++)
   {
      lengths *=
         std::sqrt(std::pow(tangents(0, j), 2) + std::pow(tangents(1, j), 2) +
                   std::pow(tangents(2, j), 2));
   }
   return lengths > 0.0 ? corner.scale * tangents.Det() / lengths : 0.0;
}

IntegrationRule PointsOf(const std::vector<Corner> &corners)
{
   IntegrationRule points;
   for (const Corner &corner : corners)
   {
      points.Append(corner.point);
   }
   return points;
}

// Looks at the elements of a geometry.
class Probe
{
public:
   explicit Probe(const FiniteElement &element)
      : corners(Corners(element.GetGeomType())),
        at_corners(element, PointsOf(corners)),
        between(element,
                element.GetOrder() > 1
                   ? JacobianPoints(element.GetGeomType(), element.GetOrder())
                   : IntegrationRule())
   {
   }

   real_t Least(const DenseMatrix &nodes) const
   {
      real_t least = std::numeric_limits<real_t>::infinity();
      DenseMatrix jacobian;
      for (int i = 0; i < at_corners.Size(); i++)
      {
         at_corners.Evaluate(nodes, i, jacobian);
         least = std::min(least, ScaledJacobianFrom(jacobian, corners[i]));
      }
      for (int i = 0; i < between.Size(); i++)
      {
         between.Evaluate(nodes, i, jacobian);
         for (const Corner &corner : corners)
         {
            least = std::min(least, ScaledJacobianFrom(jacobian, corner));
         }
      }
      return least;
   }

private:
   std::vector<Corner> corners;
   JacobianSamples at_corners;
   JacobianSamples between;
};

// The edges of an element, straight.
void EdgeRange(const Mesh &mesh, int element, real_t &shortest, real_t &longest)
{
   IsoparametricTransformation map;
   mesh.GetElementTransformation(element, &map);
   const Geometry::Type geometry = mesh.GetElementGeometry(element);
   DenseMatrix corners;
   map.Transform(*Geometries.GetVertices(geometry), corners);
   const Element &shape = *mesh.GetElement(element);
   for (int i = 0; i < shape.GetNEdges(); i++)
   {
      const int *const ends = shape.GetEdgeVertices(i);
      real_t square = 0.0;
      for (int d = 0; d < 3; d++)
      {
         square += std::pow(corners(d, ends[1]) - corners(d, ends[0]), 2);
      }
      shortest = std::min(shortest, std::sqrt(square));
      longest = std::max(longest, std::sqrt(square));
   }
}

real_t Volume(const Mesh &mesh, int element)
{
   IsoparametricTransformation map;
   mesh.GetElementTransformation(element, &map);
   const IntegrationRule &rule =
      IntRules.Get(map.GetGeometryType(), map.OrderW());
   real_t volume = 0.0;
   for (int i = 0; i < rule.GetNPoints(); i++)
   {
      map.SetIntPoint(&rule.IntPoint(i));
      volume += rule.IntPoint(i).weight * map.Weight();
   }
   return volume;
}

// All values of all ranks, on rank 0.
std::vector<real_t> Gather(MPI_Comm comm, const Vector &mine)
{
   int rank = 0;
   int ranks = 1;
   MPI_Comm_rank(comm, &rank);
   MPI_Comm_size(comm, &ranks);
   std::vector<int> sizes(ranks);
   const int size = mine.Size();
   MPI_Gather(&size, 1, MPI_INT, sizes.data(), 1, MPI_INT, 0, comm);
   std::vector<int> first(ranks, 0);
   std::partial_sum(sizes.begin(), sizes.end() - 1, first.begin() + 1);
   std::vector<real_t> all(rank == 0 ? first.back() + sizes.back() : 0);
   const MPI_Datatype real = MPITypeMap<real_t>::mpi_type;
   MPI_Gatherv(mine.GetData(), size, real, all.data(), sizes.data(),
               first.data(), real, 0, comm);
   return all;
}

real_t Median(MPI_Comm comm, const Vector &mine)
{
   std::vector<real_t> all = Gather(comm, mine);
   real_t median = 0.0;
   if (!all.empty())
   {
      const auto middle = all.begin() + all.size() / 2;
      std::nth_element(all.begin(), middle, all.end());
      median = *middle;
   }
   MPI_Bcast(&median, 1, MPITypeMap<real_t>::mpi_type, 0, comm);
   return median;
}

// Of the worst element of all ranks: its scaled Jacobian, attribute and center.
void FindWorst(const ParMesh &mesh, const Vector &values, MeshQuality &quality)
{
   const MPI_Comm comm = mesh.GetComm();
   const real_t *const worst = std::min_element(values.begin(), values.end());
   const double least_here =
      worst == values.end() ? std::numeric_limits<double>::infinity() : *worst;
   const RankedValue least = LargestOverRanks(-least_here, comm);
   quality.min_scaled_jacobian = -least.value;
   if (least.here && worst != values.end())
   {
      const int element = static_cast<int>(worst - values.begin());
      quality.worst_attribute = mesh.GetAttribute(element);
      IsoparametricTransformation map;
      mesh.GetElementTransformation(element, &map);
      Vector center(quality.worst_center, 3);
      map.Transform(Geometries.GetCenter(mesh.GetElementGeometry(element)),
                    center);
   }
   MPI_Bcast(&quality.worst_attribute, 1, MPI_INT, least.rank, comm);
   MPI_Bcast(quality.worst_center, 3, MPITypeMap<real_t>::mpi_type, least.rank,
             comm);
}

} // namespace

Vector ScaledJacobians(const Mesh &mesh)
{
   Vector values(mesh.GetNE());
   std::map<Geometry::Type, Probe> probes;
   IsoparametricTransformation map;
   for (int i = 0; i < mesh.GetNE(); i++)
   {
      mesh.GetElementTransformation(i, &map);
      const Geometry::Type geometry = map.GetGeometryType();
      auto entry = probes.find(geometry);
      if (entry == probes.end())
      {
         entry = probes.emplace(geometry, Probe(*map.GetFE())).first;
      }
      values(i) = entry->second.Least(map.GetPointMat());
   }
   return values;
}

MeshQuality MeasureQuality(const ParMesh &mesh)
{
   const MPI_Comm comm = mesh.GetComm();
   const MPI_Datatype real = MPITypeMap<real_t>::mpi_type;
   MeshQuality quality;
   const Vector values = ScaledJacobians(mesh);
   FindWorst(mesh, values, quality);
   quality.median_scaled_jacobian = Median(comm, values);

   quality.elements = mesh.GetNE();
   quality.shortest_edge = std::numeric_limits<real_t>::infinity();
   for (int i = 0; i < mesh.GetNE(); i++)
   {
      EdgeRange(mesh, i, quality.shortest_edge, quality.longest_edge);
      quality.volume += Volume(mesh, i);
   }
   MPI_Allreduce(MPI_IN_PLACE, &quality.elements, 1, MPI_LONG_LONG, MPI_SUM,
                 comm);
   MPI_Allreduce(MPI_IN_PLACE, &quality.volume, 1, real, MPI_SUM, comm);
   MPI_Allreduce(MPI_IN_PLACE, &quality.shortest_edge, 1, real, MPI_MIN, comm);
   MPI_Allreduce(MPI_IN_PLACE, &quality.longest_edge, 1, real, MPI_MAX, comm);
   return quality;
}

} // namespace synovia
