#include "synovia/contact/paired_point_shapes.hpp"

namespace synovia
{

using namespace mfem;

namespace
{
void SetShape(const FiniteElement &element, const IntegrationPoint &ip,
              Vector &shape)
{
   shape.SetSize(element.GetDof());
   element.CalcShape(ip, shape);
}

// The same without computing it twice where another element of the shape has
// that order.
void SetShape(const FiniteElement &element, const IntegrationPoint &ip,
              const FiniteElement &other, const Vector &of_other, Vector &shape)
{
   if (element.GetOrder() == other.GetOrder())
   {
      shape = of_other;
      return;
   }
   SetShape(element, ip, shape);
}

void SetSlopes(const FiniteElement &element, const IntegrationPoint &ip,
               DenseMatrix &slopes)
{
   slopes.SetSize(element.GetDof(), 2);
   element.CalcDShape(ip, slopes);
}

Point3 Scaled(real_t s, const Point3 &a)
{
   return {s * a[0], s * a[1], s * a[2]};
}
} // namespace

PairedPointShapes::PairedPointShapes(const SurfacePairing &pairing_)
   : pairing(pairing_), spaces(pairing.Destination().Spaces())
{
}

void PairedPointShapes::GoToFace(int number)
{
   if (number == face_number)
   {
      return;
   }
   face_number = number;
   face = &pairing.Destination().Faces()[number];
   destination = GetFaceDofs(pairing.Destination(), number);
   normal_rows.clear();
   for (const int vertex : face->Vertices())
   {
      for (int d = 0; d < 3; d++)
      {
         normal_rows.push_back(pairing.Normals().Row(vertex) + d);
      }
   }
}

void PairedPointShapes::SetShapes(Geometry::Type geometry,
                                  const IntegrationPoint &ip,
                                  Vector &displacement, Vector &pressure,
                                  Vector &of_vertices) const
{
   const FiniteElement &vertices = Element(spaces.Multiplier(), geometry);
   SetShape(vertices, ip, of_vertices);
   SetShape(Element(spaces.Pressure(), geometry), ip, vertices, of_vertices,
            pressure);
   SetShape(Element(spaces.Displacement(), geometry), ip, vertices, of_vertices,
            displacement);
}

void PairedPointShapes::Evaluate(const PairedPoint &point)
{
   GoToFace(point.face);
   source = &pairing.SourceFaces()[point.source];
   hit = point.hit;
   gap = point.gap;
   const Geometry::Type own = destination.geometry;
   const Geometry::Type other = source->dofs.geometry;
   SetShapes(own, point.ip, u, p, m);
   multiplier = m;
   for (int j = 0; j < m.Size(); j++)
   {
      multiplier[j] *= ShareOf(pairing.Shares(), point.face, j);
   }
   SetShapes(other, point.hit, source_u, source_p, source_m);
   const Point3 sum =
      InterpolateNormal(pairing.Normals().AtVertices(point.face), m);
   normal_length = Length(sum);
   normal = Scaled(1.0 / normal_length, sum);
   stretch = face->Current(point.ip).AreaFactor() /
             face->Reference(point.ip).AreaFactor();
}

real_t PairedPointShapes::SourceStretch() const
{
   return source->shape(hit.x, hit.y).AreaFactor() /
          source->reference(hit.x, hit.y).AreaFactor();
}

void PairedPointShapes::EvaluateWithSlopes(const PairedPoint &point)
{
   Evaluate(point);
   const Geometry::Type other = source->dofs.geometry;
   SetSlopes(Element(spaces.Displacement(), other), point.hit, source_du);
   SetSlopes(Element(spaces.Pressure(), other), point.hit, source_dp);
   for (int i = 0; i < 2; i++)
   {
      Vector slope;
      source_dp.GetColumnReference(i, slope);
      pressure_slopes[i] = slope * source->pressure;
   }
   const SurfacePoint at = source->shape(point.hit.x, point.hit.y);
   const Point3 area = at.AreaVector();
   const real_t facing = Dot(area, normal);
   along_gap = Scaled(1.0 / facing, area);
   along_hit[0] = Scaled(-1.0 / facing, Cross(at.tangents[1], normal));
   along_hit[1] = Scaled(-1.0 / facing, Cross(normal, at.tangents[0]));
}

int PairedPointShapes::DisplacementColumns() const
{
   return 3 * (source_u.Size() + u.Size());
}

int PairedPointShapes::Columns() const
{
   return DisplacementColumns() + 3 * m.Size();
}

void PairedPointShapes::Row(const Point3 &along, Vector &row) const
{
   row.SetSize(Columns());
   int column = 0;
   const auto append = [&](const Point3 &factor, const Vector &shape)
   {
      for (int k = 0; k < shape.Size(); k++)
      {
         for (int d = 0; d < 3; d++)
         {
            row[column++] = shape[k] * factor[d];
         }
      }
   };
   append(along, source_u);
   append(Scaled(-1.0, along), u);
   append(Scaled(-gap / normal_length, Across(normal, along)), m);
}

std::array<Point3, 3> PairedPointShapes::NormalTurn() const
{
   std::array<Point3, 3> turn;
   for (int d = 0; d < 3; d++)
   {
      Point3 unit{{0.0, 0.0, 0.0}};
      unit[d] = 1.0;
      turn[d] = Scaled(1.0 / normal_length, Across(normal, unit));
   }
   return turn;
}

Point3 PairedPointShapes::NormalChange(int vertex, int d) const
{
   return Scaled(m[vertex], NormalTurn()[d]);
}

} // namespace synovia
