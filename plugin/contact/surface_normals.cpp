#include "synovia/contact/surface_normals.hpp"
#include "synovia/general/parallel_triplets.hpp"

namespace synovia
{

using namespace mfem;

namespace
{
/// Area vector of a face at a vertex, for a face of that size.
Point3 VertexArea(const DeformedFace &face, const IntegrationPoint &vertex)
{
   Point3 area = face.Current(vertex).AreaVector();
   for (real_t &component : area)
   {
      component *= Geometry::Volume[face.GetGeometry()];
   }
   return area;
}
} // namespace

SurfaceNormals::SurfaceNormals(const ContactSurface &surface_)
   : surface(surface_), normals(surface.Faces().size()),
     lengths(surface.Faces().size())
{
   const HYPRE_BigInt *vertices = surface.Vertices().Offsets();
   offsets = {3 * vertices[0], 3 * vertices[1]};
}

HYPRE_BigInt SurfaceNormals::Row(int vertex) const
{
   return 3 * surface.Vertices().Global(vertex);
}

HYPRE_BigInt SurfaceNormals::GlobalRows() const
{
   return 3 * surface.Vertices().GlobalSize();
}

void SurfaceNormals::Update()
{
   const SurfaceVertices &all = surface.Vertices();
   std::array<Vector, 3> sums;
   for (Vector &component : sums)
   {
      component.SetSize(all.LocalSize());
      component = 0.0;
   }
   for (const DeformedFace &face : surface.Faces())
   {
      const Array<int> &vertices = face.Vertices();
      const IntegrationRule &ends = *Geometries.GetVertices(face.GetGeometry());
      for (int v = 0; v < vertices.Size(); v++)
      {
         const Point3 area = VertexArea(face, ends.IntPoint(v));
         for (int d = 0; d < 3; d++)
         {
            sums[d][vertices[v]] += area[d];
         }
      }
   }
   for (Vector &component : sums)
   {
      component = all.Share(all.SumShared(component));
   }
   for (std::size_t i = 0; i < normals.size(); i++)
   {
      const Array<int> &vertices = surface.Faces()[i].Vertices();
      for (int v = 0; v < vertices.Size(); v++)
      {
         const int at = vertices[v];
         const Point3 sum{sums[0][at], sums[1][at], sums[2][at]};
         const real_t length = Length(sum);
         lengths[i][v] = length;
         normals[i][v] = {sum[0] / length, sum[1] / length, sum[2] / length};
      }
   }
}

std::unique_ptr<HypreParMatrix> SurfaceNormals::Derivative() const
{
   ParFiniteElementSpace &space = surface.Spaces().Displacement();
   std::vector<Triplet> triplets;
   DenseMatrix slopes;
   for (std::size_t i = 0; i < normals.size(); i++)
   {
      const DeformedFace &face = surface.Faces()[i];
      const Geometry::Type geometry = face.GetGeometry();
      const FiniteElement &element =
         *space.FEColl()->FiniteElementForGeometry(geometry);
      const IntegrationRule &ends = *Geometries.GetVertices(geometry);
      slopes.SetSize(element.GetDof(), 2);
      for (int v = 0; v < face.Vertices().Size(); v++)
      {
         element.CalcDShape(ends.IntPoint(v), slopes);
         const SurfacePoint at = face.Current(ends.IntPoint(v));
         const HYPRE_BigInt row = Row(face.Vertices()[v]);
         const real_t scale = Geometry::Volume[geometry] / lengths[i][v];
         for (int j = 0; j < face.DisplacementDofs().Size(); j++)
         {
            Point3 unit{{0.0, 0.0, 0.0}};
            unit[j % 3] = 1.0;
            const Point3 by_first = Cross(unit, at.tangents[1]);
            const Point3 by_second = Cross(at.tangents[0], unit);
            Point3 change{{0.0, 0.0, 0.0}};
            change = Sum(change, scale * slopes(j / 3, 0), by_first);
            change = Sum(change, scale * slopes(j / 3, 1), by_second);
            change = Across(normals[i][v], change);
            const HYPRE_BigInt column =
               space.GetGlobalTDofNumber(face.DisplacementDofs()[j]);
            for (int d = 0; d < 3; d++)
            {
               if (change[d] != 0.0)
               {
                  triplets.push_back({row + d, column, change[d]});
               }
            }
         }
      }
   }
   return AssembleTriplets(space.GetComm(), triplets, RowOffsets(),
                           GlobalRows(), space.GetTrueDofOffsets(),
                           space.GlobalTrueVSize());
}

} // namespace synovia
