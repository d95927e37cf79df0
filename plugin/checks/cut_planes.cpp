#include "synovia/checks/cut_planes.hpp"
#include "synovia/checks/body_shape.hpp"
#include "synovia/checks/surface_conditions.hpp"
#include "synovia/general/reduce_lists.hpp"
#include "synovia/general/text_table.hpp"
#include "synovia/mesh/triangulated_surface.hpp"

#include <algorithm>
#include <cmath>
#include <set>

namespace synovia
{

using namespace mfem;

namespace
{
// Coordinates that differ by less than this part of the mesh's size are the
// same, and areas below this part of the body's count nothing.
constexpr real_t same = 1e-6;
constexpr real_t negligible = 1e-3;

constexpr int planes = 6;

/// The side of a body's bounding box, and its faces there.
struct EndPlane
{
   real_t coordinate = 0.0;
   /// Areas of all faces in it, of those without a condition, and of those with
   /// that of a plane of symmetry.
   real_t area = 0.0;
   real_t bare = 0.0;
   real_t symmetric = 0.0;
   /// Attributes without a condition.
   std::set<int> bare_surfaces;
};

/// Plane 2 d + s of a body is the low (s = 0) or the high side along axis d.
class EndPlanes
{
public:
   EndPlanes(const SurfaceConditions &conditions, ParMesh &mesh,
             const std::vector<Body> &bodies)
      : ends(planes * bodies.size()), body_area(bodies.size(), 0.0),
        body_of(BodyOfRegions(bodies, mesh.attributes.Max()))
   {
      FindCoordinates(mesh);
      AddFaces(conditions, mesh);
   }

   const EndPlane &Of(size_t body, int plane) const
   {
      return ends[planes * body + plane];
   }
   /// Whether the body has more than a few bare faces in it.
   bool IsBare(size_t body, int plane) const
   {
      return Of(body, plane).bare > negligible * body_area[body];
   }
   bool AreOne(const EndPlane &a, const EndPlane &b) const
   {
      return std::abs(a.coordinate - b.coordinate) <= tolerance;
   }

private:
   void FindCoordinates(ParMesh &mesh)
   {
      // Of lows and of highs with their signs turned, for one reduction.
      std::vector<real_t> least(ends.size(),
                                std::numeric_limits<real_t>::max());
      ForEachTriangle(mesh,
                      [&](int boundary, size_t body, const Triangle &triangle)
                      {
                         (void)boundary;
                         for (const Point3 &corner : triangle)
                         {
                            for (int d = 0; d < 3; d++)
                            {
                               real_t *const low =
                                  &least[planes * body + 2 * d];
                               low[0] = std::min(low[0], corner[d]);
                               low[1] = std::min(low[1], -corner[d]);
                            }
                         }
                      });
      MinOverRanks(least, mesh.GetComm());
      for (size_t i = 0; i < ends.size(); i++)
      {
         ends[i].coordinate = i % 2 == 0 ? least[i] : -least[i];
      }
      real_t size = 0.0;
      for (size_t i = 0; i < ends.size(); i += 2)
      {
         size = std::max(size, ends[i + 1].coordinate - ends[i].coordinate);
      }
      tolerance = same * size;
   }

   void AddFaces(const SurfaceConditions &conditions, ParMesh &mesh)
   {
      const int surfaces =
         mesh.bdr_attributes.IsEmpty() ? 1 : mesh.bdr_attributes.Max() + 1;
      std::vector<real_t> areas(surfaces * ends.size(), 0.0);
      ForEachTriangle(
         mesh,
         [&](int boundary, size_t body, const Triangle &triangle)
         {
            const real_t area = 0.5 * Length(AreaVector(triangle));
            body_area[body] += area;
            for (int p = 0; p < planes; p++)
            {
               const size_t end = planes * body + p;
               if (IsIn(triangle, p / 2, ends[end].coordinate))
               {
                  areas[surfaces * end + mesh.GetBdrAttribute(boundary)] +=
                     area;
               }
            }
         });
      SumOverRanks(areas, mesh.GetComm());
      SumOverRanks(body_area, mesh.GetComm());
      for (size_t i = 0; i < areas.size(); i++)
      {
         const int attribute = static_cast<int>(i % surfaces);
         const int axis = static_cast<int>(i / surfaces % planes / 2);
         EndPlane &end = ends[i / surfaces];
         end.area += areas[i];
         if (areas[i] > 0.0 && conditions.None(attribute))
         {
            end.bare += areas[i];
            end.bare_surfaces.insert(attribute);
         }
         else if (conditions.IsSymmetry(attribute, axis))
         {
            end.symmetric += areas[i];
         }
      }
   }

   template <typename Visit>
   void ForEachTriangle(ParMesh &mesh, Visit visit)
   {
      for (int i = 0; i < mesh.GetNBE(); i++)
      {
         const size_t body = body_of[RegionBehind(mesh, i)];
         for (const Triangle &triangle : Triangulate(mesh, i))
         {
            visit(i, body, triangle);
         }
      }
   }

   bool IsIn(const Triangle &triangle, int axis, real_t coordinate) const
   {
      return std::all_of(
         triangle.begin(), triangle.end(),
         [&](const Point3 &corner)
         { return std::abs(corner[axis] - coordinate) <= tolerance; });
   }

   std::vector<EndPlane> ends;
   std::vector<real_t> body_area;
   std::vector<int> body_of;
   real_t tolerance = 0.0;
};

/// Why a plane may be one of symmetry.
class CutJudge
{
public:
   CutJudge(const EndPlanes &ends_, const std::vector<Body> &bodies_)
      : ends(ends_), bodies(bodies_)
   {
   }

   /// Empty if it doesn't.
   std::string Reason(size_t body, int plane) const
   {
      const EndPlane &end = ends.Of(body, plane);
      for (size_t other = 0; other < bodies.size(); other++)
      {
         const EndPlane &there = ends.Of(other, plane);
         if (ends.AreOne(end, there) && there.symmetric > 0.0)
         {
            return other == body
                      ? "the rest of the plane has the condition of a plane of "
                        "symmetry"
                      : "\"" + bodies[other].name +
                           "\" has a plane of symmetry there";
         }
      }
      for (size_t other = 0; other < bodies.size(); other++)
      {
         if (other != body && BothEnd(body, other, plane))
         {
            return "\"" + bodies[other].name + "\" ends there too";
         }
      }
      if (HasOtherSymmetry(body, plane) && ends.Of(body, plane ^ 1).area == 0.0)
      {
         return "there is another plane of symmetry and the body is not flat "
                "on the far side";
      }
      return "";
   }

private:
   // Not side by side on both ends, as blocks of one width do.
   bool BothEnd(size_t body, size_t other, int plane) const
   {
      const int far_side = plane ^ 1;
      return ends.AreOne(ends.Of(body, plane), ends.Of(other, plane)) &&
             ends.IsBare(other, plane) &&
             !(ends.AreOne(ends.Of(body, far_side), ends.Of(other, far_side)) &&
               ends.IsBare(body, far_side) && ends.IsBare(other, far_side));
   }

   bool HasOtherSymmetry(size_t body, int plane) const
   {
      for (int p = 0; p < planes; p++)
      {
         if (p / 2 != plane / 2 && ends.Of(body, p).symmetric > 0.0)
         {
            return true;
         }
      }
      return false;
   }

   const EndPlanes &ends;
   const std::vector<Body> &bodies;
};

std::string SurfaceNames(const NameTable &names, const std::set<int> &surfaces)
{
   std::string text;
   bool nameless = false;
   for (const int attribute : surfaces)
   {
      const std::string name = NameOf(names, attribute);
      if (name == std::to_string(attribute))
      {
         nameless = true;
         continue;
      }
      text += (text.empty() ? "\"" : ", \"") + name + "\"";
   }
   return nameless
             ? text + (text.empty() ? "" : " and ") + "faces without a name"
             : text;
}

std::string SymmetryText(int axis)
{
   std::string text;
   for (int d = 0; d < 3; d++)
   {
      text += (d == 0 ? "[" : ", ") + std::string(d == axis ? "0" : "\"free\"");
   }
   return text + "]";
}
} // namespace

std::vector<std::string> FindCutWarnings(const CaseFile &setup,
                                         CaseProblem &problem,
                                         const std::vector<Body> &bodies)
{
   NamedMesh &mesh = problem.Get().Mesh();
   const SurfaceConditions conditions(setup, mesh);
   const EndPlanes ends(conditions, mesh.Get(), bodies);
   const CutJudge judge(ends, bodies);
   std::vector<std::string> warnings;
   for (size_t b = 0; b < bodies.size(); b++)
   {
      for (int p = 0; p < planes; p++)
      {
         const std::string reason = ends.IsBare(b, p) ? judge.Reason(b, p) : "";
         if (reason.empty())
         {
            continue;
         }
         const EndPlane &end = ends.Of(b, p);
         warnings.push_back(
            WhereIs(setup.places, "boundary") + ": no condition names " +
            SurfaceNames(mesh.Boundaries(), end.bare_surfaces) + " of \"" +
            bodies[b].name + "\" in the plane " + "xyz"[p / 2] + " = " +
            Quantity(end.coordinate) + " (area " + Quantity(end.bare) +
            ", free of traction and sealed), which looks like a cut: " +
            reason +
            "; if it is a plane of symmetry, prescribe displacement = " +
            SymmetryText(p / 2));
      }
   }
   return warnings;
}

} // namespace synovia
