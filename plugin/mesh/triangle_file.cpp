#include "synovia/mesh/triangle_file.hpp"
#include "synovia/general/error.hpp"
#include "synovia/mesh/msh_contents.hpp"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <limits>
#include <map>
#include <set>
#include <sstream>

namespace synovia
{

using namespace mfem;

namespace
{
/// Corners by their places.
class CornerTable
{
public:
   CornerTable(SurfaceSheet &sheet_, real_t scale_)
      : sheet(sheet_), scale(scale_)
   {
   }

   void AddFacet(const std::vector<Point3> &points)
   {
      std::vector<int> corners;
      for (const Point3 &point : points)
      {
         const Point3 place = Sum({{0.0, 0.0, 0.0}}, scale, point);
         const auto [entry, fresh] =
            numbers.emplace(place, static_cast<int>(numbers.size()));
         if (fresh)
         {
            sheet.Add(place, place);
         }
         corners.push_back(entry->second);
      }
      const std::set<int> distinct(corners.begin(), corners.end());
      if (distinct.size() < corners.size())
      {
         return; // without area
      }
      if (corners.size() == 3)
      {
         sheet.AddTriangle(corners[0], corners[1], corners[2]);
      }
      else
      {
         sheet.AddQuadrilateral(corners[0], corners[1], corners[2], corners[3]);
      }
   }

private:
   SurfaceSheet &sheet;
   real_t scale;
   std::map<Point3, int> numbers;
};

std::string Contents(const std::string &path)
{
   std::ifstream in(path, std::ios::binary);
   std::stringstream text;
   text << in.rdbuf();
   if (!in || text.fail())
   {
      throw Error("it cannot be read; is it there?");
   }
   return text.str();
}

constexpr size_t stl_header = 80;
constexpr size_t stl_facet = 50;

bool IsBinaryStl(const std::string &text)
{
   if (text.size() < stl_header + sizeof(std::uint32_t))
   {
      return false;
   }
   std::uint32_t count = 0;
   std::memcpy(&count, text.data() + stl_header, sizeof(count));
   return text.size() == stl_header + sizeof(count) + stl_facet * count;
}

void ReadBinaryStl(const std::string &text, CornerTable &corners)
{
   const char *at = text.data() + stl_header + sizeof(std::uint32_t);
   for (; at < text.data() + text.size(); at += stl_facet)
   {
      // The normal comes first.
      float numbers[12];
      std::memcpy(numbers, at, sizeof(numbers));
      std::vector<Point3> points;
      for (int k = 3; k < 12; k += 3)
      {
         points.push_back({numbers[k], numbers[k + 1], numbers[k + 2]});
      }
      corners.AddFacet(points);
   }
}

void ReadAsciiStl(const std::string &text, CornerTable &corners)
{
   std::istringstream in(text);
   std::string word;
   std::vector<Point3> points;
   while (in >> word)
   {
      if (word == "vertex")
      {
         Point3 point;
         if (!(in >> point[0] >> point[1] >> point[2]))
         {
            throw Error("a vertex has no three numbers");
         }
         points.push_back(point);
      }
      else if (word == "endfacet")
      {
         if (points.size() != 3)
         {
            throw Error("a facet has " + std::to_string(points.size()) +
                        " vertices; it must have three");
         }
         corners.AddFacet(points);
         points.clear();
      }
   }
}

void ReadMshFacets(const std::string &path, CornerTable &corners)
{
   const MshContents contents = ReadMsh(path);
   // Triangles and quadrilaterals of orders 1 and 2 by gmsh's numbers.
   const std::map<int, int> corners_of{
      {2, 3}, {9, 3}, {3, 4}, {16, 4}, {10, 4}};
   for (const MshCell &cell : contents.surfaces.list)
   {
      const auto count = corners_of.find(cell.type);
      if (count == corners_of.end())
      {
         throw Error("it has faces of gmsh's type " +
                     std::to_string(cell.type) +
                     "; there are triangles and quadrilaterals of orders 1 and "
                     "2");
      }
      std::vector<Point3> points;
      for (int k = 0; k < count->second; k++)
      {
         const double *x =
            &contents.coordinates[3 * contents.surfaces.nodes[cell.first + k]];
         points.push_back({x[0], x[1], x[2]});
      }
      corners.AddFacet(points);
   }
}

int CornersOf(const SurfaceSheet::Facet &facet)
{
   return facet.corners[3] < 0 ? 3 : 4;
}

// Each edge belongs to one facet in each direction.
void VerifyEdges(const SurfaceSheet &sheet)
{
   std::set<std::pair<int, int>> seen;
   for (const SurfaceSheet::Facet &facet : sheet.facets)
   {
      const int count = CornersOf(facet);
      for (int i = 0; i < count; i++)
      {
         const int a = facet.corners[i];
         const int b = facet.corners[(i + 1) % count];
         if (!seen.insert({a, b}).second)
         {
            throw Error("more than two facets meet in an edge, or neighbors "
                        "have different sides outside; give one surface whose "
                        "facets are counter-clockwise as seen from outside");
         }
      }
   }
}

Point3 FacetArea(const SurfaceSheet &sheet, const SurfaceSheet::Facet &facet)
{
   const auto at = [&](int i) { return sheet.outer[facet.corners[i]]; };
   const int last = CornersOf(facet) - 1;
   return Cross(Sum(at(last == 3 ? 2 : 1), -1.0, at(0)),
                Sum(at(last), -1.0, at(last == 3 ? 1 : 0)));
}
} // namespace

SurfaceSheet ReadFacets(const std::string &path, real_t scale)
{
   SurfaceSheet sheet;
   CornerTable corners(sheet, scale);
   const std::string text = Contents(path);
   if (text.rfind("$MeshFormat", 0) == 0)
   {
      ReadMshFacets(path, corners);
   }
   else if (IsBinaryStl(text))
   {
      ReadBinaryStl(text, corners);
   }
   else
   {
      ReadAsciiStl(text, corners);
   }
   if (sheet.facets.empty())
   {
      throw Error("it has no facets; give an STL file, or an MSH file with "
                  "surface elements");
   }
   VerifyEdges(sheet);
   return sheet;
}

void Thicken(SurfaceSheet &sheet)
{
   constexpr real_t part_of_edge = 0.1;
   std::vector<Point3> normals(sheet.outer.size(), {{0.0, 0.0, 0.0}});
   real_t shortest = std::numeric_limits<real_t>::infinity();
   for (const SurfaceSheet::Facet &facet : sheet.facets)
   {
      const Point3 area = FacetArea(sheet, facet);
      const int count = CornersOf(facet);
      for (int i = 0; i < count; i++)
      {
         const int a = facet.corners[i];
         const int b = facet.corners[(i + 1) % count];
         normals[a] = Sum(normals[a], 1.0, area);
         shortest = std::min(shortest,
                             Length(Sum(sheet.outer[a], -1.0, sheet.outer[b])));
      }
   }
   for (size_t i = 0; i < normals.size(); i++)
   {
      const real_t length = Length(normals[i]);
      if (length > 0.0)
      {
         sheet.inner[i] =
            Sum(sheet.outer[i], -part_of_edge * shortest / length, normals[i]);
      }
   }
}

} // namespace synovia
