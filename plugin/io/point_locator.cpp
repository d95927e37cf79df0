#include "synovia/io/point_locator.hpp"
#include "synovia/general/error.hpp"
#include "synovia/general/text.hpp"

#include <algorithm>
#include <limits>

namespace synovia
{

using namespace mfem;

namespace
{
using Point = std::array<real_t, 3>;

constexpr real_t far_away = std::numeric_limits<real_t>::max();
/// Parts of an element's size that a point may lie outside.
constexpr real_t slack = 0.05;

/// The bounding box of an element's nodes.
struct Extent
{
   explicit Extent(const DenseMatrix &nodes)
   {
      for (int d = 0; d < 3; d++)
      {
         low[d] = far_away;
         high[d] = -far_away;
         for (int i = 0; i < nodes.Width(); i++)
         {
            low[d] = std::min(low[d], nodes(d, i));
            high[d] = std::max(high[d], nodes(d, i));
         }
         size = std::max(size, high[d] - low[d]);
      }
   }

   bool Contains(const Point &x, real_t margin) const
   {
      for (int d = 0; d < 3; d++)
      {
         if (x[d] < low[d] - margin || x[d] > high[d] + margin)
         {
            return false;
         }
      }
      return true;
   }

   Point low;
   Point high;
   real_t size = 0.0;
};

/// Inverts the map of an element.
///
/// MFEM's InverseElementTransformation gives no point where it finds x outside,
/// and takes some points on faces for outside by rounding.
class InverseMap
{
public:
   explicit InverseMap(ElementTransformation &trans_)
      : trans(trans_), geometry(trans.GetGeometryType()), image(3), step(3)
   {
   }

   /// Sets @a ip to the nearest, or nearly nearest, point of the element and
   /// gives its distance from x.
   real_t Nearest(const Point &x, IntegrationPoint &ip)
   {
      ip = Geometries.GetCenter(geometry);
      return Search(x, true, ip);
   }

   /// Moves @a ip, the nearest point, out of the element to x itself, unless x
   /// is out of reach of the element's polynomials.
   void Continue(const Point &x, real_t tolerance, IntegrationPoint &ip)
   {
      IntegrationPoint outside = ip;
      if (Search(x, false, outside) < tolerance)
      {
         ip = outside;
      }
   }

private:
   /// Newton's method from @a ip, which becomes the best point on the way.
   real_t Search(const Point &x, bool inside, IntegrationPoint &ip)
   {
      const Vector target(const_cast<real_t *>(x.data()), 3);
      IntegrationPoint trial = ip;
      real_t best = far_away;
      for (int i = 0; i < 20; i++)
      {
         trans.SetIntPoint(&trial);
         trans.Transform(trial, image);
         subtract(target, image, image);
         const real_t distance = image.Norml2();
         if (distance < best)
         {
            best = distance;
            ip = trial;
         }
         trans.InverseJacobian().Mult(image, step);
         const IntegrationPoint last = trial;
         trial.Set3(last.x + step(0), last.y + step(1), last.z + step(2));
         if (inside)
         {
            Geometry::ProjectPoint(geometry, trial);
         }
         if (std::abs(trial.x - last.x) + std::abs(trial.y - last.y) +
                std::abs(trial.z - last.z) <
             1e-14)
         {
            break;
         }
      }
      return best;
   }

   ElementTransformation &trans;
   Geometry::Type geometry;
   Vector image;
   Vector step;
};
} // namespace

std::vector<LocatedPoint> LocatePoints(const ParMesh &mesh,
                                       const Array<int> &attributes,
                                       const std::vector<Point> &points)
{
   const int count = static_cast<int>(points.size());
   std::vector<LocatedPoint> found(count);
   std::vector<real_t> distance(count, far_away);
   IsoparametricTransformation trans;
   for (int e = 0; e < mesh.GetNE(); e++)
   {
      if (attributes.Size() && attributes.Find(mesh.GetAttribute(e)) < 0)
      {
         continue;
      }
      mesh.GetElementTransformation(e, &trans);
      const Extent extent(trans.GetPointMat());
      InverseMap inverse(trans);
      // Curved elements may bulge out of the box of their nodes.
      const real_t margin = (trans.Order() > 1 ? 0.3 : slack) * extent.size;
      for (int i = 0; i < count; i++)
      {
         if (!extent.Contains(points[i], margin))
         {
            continue;
         }
         IntegrationPoint ip;
         real_t outside = inverse.Nearest(points[i], ip);
         // Rounding shall not decide between elements, nor between ranks.
         outside = outside < 1e-10 * extent.size ? 0.0 : outside;
         if (outside <= slack * extent.size && outside < distance[i])
         {
            inverse.Continue(points[i], 1e-10 * extent.size, ip);
            distance[i] = outside;
            found[i].element = e;
            found[i].ip = ip;
         }
      }
   }

   int rank = 0;
   MPI_Comm_rank(mesh.GetComm(), &rank);
   struct Claim
   {
      double distance;
      int rank;
   };
   std::vector<Claim> claims(count);
   for (int i = 0; i < count; i++)
   {
      claims[i] = {static_cast<double>(distance[i]), rank};
   }
   MPI_Allreduce(MPI_IN_PLACE, claims.data(), count, MPI_DOUBLE_INT, MPI_MINLOC,
                 mesh.GetComm());
   int lost = 0;
   std::string where;
   for (int i = 0; i < count; i++)
   {
      if (claims[i].distance == static_cast<double>(far_away))
      {
         if (lost++ == 0)
         {
            where = "(" + ToText(points[i][0]) + ", " + ToText(points[i][1]) +
                    ", " + ToText(points[i][2]) + ")";
         }
      }
      else if (claims[i].rank != rank)
      {
         found[i].element = -1;
      }
   }
   if (lost)
   {
      throw Error(std::to_string(lost) + " of " + std::to_string(count) +
                  " points are not in the region, the first of them " + where);
   }
   return found;
}

} // namespace synovia
