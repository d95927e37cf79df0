#include "synovia/io/vtu_piece.hpp"

#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <sstream>

namespace synovia
{

using namespace mfem;

namespace
{
template <typename Number>
void WriteArray(std::ostream &out, const std::string &attributes,
                const std::vector<Number> &values, int compression)
{
   out << "<DataArray " << attributes << " format=\"binary\">\n";
   std::vector<char> bytes;
   bytes.reserve(values.size() * sizeof(Number));
   for (const Number value : values)
   {
      bin_io::AppendBytes(bytes, value);
   }
   WriteBase64WithSizeAndClear(out, bytes, compression);
   out << "</DataArray>\n";
}

/// For each of the points, which of the element's nodes is there.
std::vector<int> NodesAt(const IntegrationRule &points,
                         const FiniteElement &element)
{
   const IntegrationRule &nodes = element.GetNodes();
   std::vector<int> found;
   for (const IntegrationPoint &point : points)
   {
      int nearest = 0;
      real_t least = std::numeric_limits<real_t>::max();
      for (int i = 0; i < nodes.GetNPoints(); i++)
      {
         const IntegrationPoint &node = nodes.IntPoint(i);
         const real_t distance =
            std::hypot(node.x - point.x, node.y - point.y, node.z - point.z);
         if (distance < least)
         {
            least = distance;
            nearest = i;
         }
      }
      found.push_back(nearest);
   }
   return found;
}
} // namespace

VtuPiece::VtuPiece(ParMesh &mesh_, int order_, int compression_)
   : mesh(mesh_), order(order_), compression(compression_)
{
   NumberNodes();
   EncodeMesh();
}

const IntegrationRule &VtuPiece::Points(int element) const
{
   return GlobGeometryRefiner
      .Refine(mesh.GetElementBaseGeometry(element), order, 1)
      ->RefPts;
}

void VtuPiece::NumberNodes()
{
   // VTK's nodes are equidistant.
   const H1_FECollection elements(order, mesh.Dimension(),
                                  BasisType::ClosedUniform);
   FiniteElementSpace space(&mesh, &elements);
   node_count = space.GetNDofs();
   std::map<Geometry::Type, std::vector<int>> places;
   std::vector<bool> covered(node_count, false);
   Array<int> dofs;
   first = {0};
   for (int e = 0; e < mesh.GetNE(); e++)
   {
      std::vector<int> &place = places[mesh.GetElementBaseGeometry(e)];
      if (place.empty())
      {
         place = NodesAt(Points(e), *space.GetFE(e));
      }
      space.GetElementDofs(e, dofs);
      bool needed = false;
      for (const int i : place)
      {
         nodes.push_back(dofs[i]);
         needed = needed || !covered[dofs[i]];
         covered[dofs[i]] = true;
      }
      first.push_back(static_cast<int>(nodes.size()));
      if (needed)
      {
         covering.push_back(e);
      }
   }
}

void VtuPiece::EncodeMesh()
{
   std::vector<double> points(std::size_t(3) * node_count, 0.0);
   DenseMatrix x;
   for (const int e : covering)
   {
      mesh.GetElementTransformation(e)->Transform(Points(e), x);
      for (int j = 0; j < x.Width(); j++)
      {
         for (int d = 0; d < x.Height(); d++)
         {
            points[3 * nodes[first[e] + j] + d] = x(d, j);
         }
      }
   }
   std::vector<int32_t> connectivity;
   std::vector<int32_t> ends;
   std::vector<uint8_t> types;
   std::vector<int32_t> attributes;
   std::map<Geometry::Type, Array<int>> sequences;
   for (int e = 0; e < mesh.GetNE(); e++)
   {
      const Geometry::Type geometry = mesh.GetElementBaseGeometry(e);
      Array<int> &sequence = sequences[geometry];
      if (sequence.Size() == 0)
      {
         CreateVTKElementConnectivity(sequence, geometry, order);
      }
      for (const int j : sequence)
      {
         connectivity.push_back(nodes[first[e] + j]);
      }
      ends.push_back(static_cast<int32_t>(connectivity.size()));
      types.push_back(
         static_cast<uint8_t>(VTKGeometry::HighOrderMap[geometry]));
      attributes.push_back(mesh.GetAttribute(e));
   }
   std::ostringstream out;
   out << "<Piece NumberOfPoints=\"" << node_count << "\" NumberOfCells=\""
       << mesh.GetNE() << "\">\n<Points>\n";
   WriteArray(out, "type=\"Float64\" NumberOfComponents=\"3\"", points,
              compression);
   out << "</Points>\n<Cells>\n";
   WriteArray(out, "type=\"Int32\" Name=\"connectivity\"", connectivity,
              compression);
   WriteArray(out, "type=\"Int32\" Name=\"offsets\"", ends, compression);
   WriteArray(out, "type=\"UInt8\" Name=\"types\"", types, compression);
   out << "</Cells>\n<CellData Scalars=\"attribute\">\n";
   WriteArray(out, "type=\"Int32\" Name=\"attribute\"", attributes,
              compression);
   out << "</CellData>\n";
   encoded_mesh = out.str();
}

std::vector<double> VtuPiece::NodalValues(const ParGridFunction &field) const
{
   const int components = field.VectorDim();
   std::vector<double> values(std::size_t(components) * node_count, 0.0);
   DenseMatrix at_points;
   Vector scalars;
   for (const int e : covering)
   {
      if (components == 1)
      {
         field.GetValues(e, Points(e), scalars);
         at_points.UseExternalData(scalars.GetData(), 1, scalars.Size());
      }
      else
      {
         field.GetVectorValues(*mesh.GetElementTransformation(e), Points(e),
                               at_points);
      }
      for (int j = 0; j < at_points.Width(); j++)
      {
         for (int c = 0; c < components; c++)
         {
            values[components * nodes[first[e] + j] + c] = at_points(c, j);
         }
      }
      if (components == 1)
      {
         at_points.ClearExternalData();
      }
   }
   return values;
}

void VtuPiece::Write(std::ostream &out, const Fields &fields) const
{
   out << "<VTKFile type=\"UnstructuredGrid\""
       << (compression == 0 ? "" : " compressor=\"vtkZLibDataCompressor\"")
       << " version=\"2.2\" byte_order=\"" << VTKByteOrder()
       << "\">\n<UnstructuredGrid>\n"
       << encoded_mesh << "<PointData>\n";
   for (const auto &[name, field] : fields)
   {
      const int components = field->VectorDim();
      WriteArray(out,
                 "type=\"Float64\" Name=\"" + name +
                    "\" NumberOfComponents=\"" + std::to_string(components) +
                    "\" " + VTKComponentLabels(components),
                 NodalValues(*field), compression);
   }
   out << "</PointData>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>"
       << std::endl;
}

} // namespace synovia
