#include "synovia/feb/msh_writer.hpp"

#include <algorithm>
#include <limits>
#include <sstream>

namespace synovia
{

namespace
{
constexpr int triangle_type = 2;
constexpr int square_type = 3;

void WriteElement(long long number, int type, int group, std::ostream &out)
{
   out << number << ' ' << type << " 2 " << group << ' ' << group;
}

// At time 0.
void WriteVectors(const std::string &name,
                  const std::map<long long, Point3> &vectors, std::ostream &out)
{
   out << "$ElementData\n1\n\"" << name << "\"\n1\n0\n3\n0\n3\n"
       << vectors.size() << '\n';
   for (const auto &[number, vector] : vectors)
   {
      out << number << ' ' << vector[0] << ' ' << vector[1] << ' ' << vector[2]
          << '\n';
   }
   out << "$EndElementData\n";
}
} // namespace

std::string
MshText(const FebMesh &mesh, const std::set<int> &parts,
        const FebSurfaces &surfaces,
        const std::map<std::string, FebElementData::Vectors> &fields)
{
   std::ostringstream out;
   out.precision(std::numeric_limits<double>::max_digits10);
   out << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n"
       << parts.size() + surfaces.Groups().size() << '\n';
   int group = 0;
   for (const int p : parts)
   {
      out << "3 " << ++group << " \"" << mesh.parts[p].name << "\"\n";
   }
   for (const FebSurfaces::Group &surface : surfaces.Groups())
   {
      out << "2 " << ++group << " \"" << surface.name << "\"\n";
   }
   out << "$EndPhysicalNames\n$Nodes\n";
   size_t used = 0;
   for (size_t i = 0; i < mesh.nodes.size(); i++)
   {
      used += surfaces.IsUsed(static_cast<int>(i)) ? 1 : 0;
   }
   out << used << '\n';
   for (size_t i = 0; i < mesh.nodes.size(); i++)
   {
      if (surfaces.IsUsed(static_cast<int>(i)))
      {
         const Point3 &x = mesh.nodes[i];
         out << mesh.numbers[i] << ' ' << x[0] << ' ' << x[1] << ' ' << x[2]
             << '\n';
      }
   }
   out << "$EndNodes\n$Elements\n";
   size_t elements = 0;
   long long number = 0;
   for (const int p : parts)
   {
      elements += mesh.parts[p].cells.size();
      for (const FebCell &cell : mesh.parts[p].cells)
      {
         number = std::max(number, cell.number);
      }
   }
   for (const FebSurfaces::Group &surface : surfaces.Groups())
   {
      elements += surface.faces.size();
   }
   out << elements << '\n';
   group = 0;
   for (const int p : parts)
   {
      const FebPart &part = mesh.parts[p];
      group++;
      for (const FebCell &cell : part.cells)
      {
         WriteElement(cell.number, part.shape->gmsh_type, group, out);
         for (const int place : part.shape->order_in_gmsh)
         {
            out << ' ' << mesh.numbers[cell.nodes[place]];
         }
         out << '\n';
      }
   }
   for (const FebSurfaces::Group &surface : surfaces.Groups())
   {
      group++;
      for (const int face : surface.faces)
      {
         const std::vector<int> &corners = surfaces.Corners(face);
         WriteElement(++number,
                      corners.size() == 3 ? triangle_type : square_type, group,
                      out);
         for (const int node : corners)
         {
            out << ' ' << mesh.numbers[node];
         }
         out << '\n';
      }
   }
   out << "$EndElements\n";
   for (const auto &[name, vectors] : fields)
   {
      WriteVectors(name, {vectors.begin(), vectors.end()}, out);
   }
   return out.str();
}

} // namespace synovia
