#include "synovia/contact/displacement_change.hpp"
#include "synovia/contact/finite_gap.hpp"
#include "synovia/contact/point_range.hpp"
#include "synovia/contact/vertex_blocks.hpp"

namespace synovia
{

using namespace mfem;

namespace
{
constexpr std::array<Point3, 3> axes{
   {{{1.0, 0.0, 0.0}}, {{0.0, 1.0, 0.0}}, {{0.0, 0.0, 1.0}}}};

/// What the points on one pair of faces add to the changes.
class FacePairSliding
{
public:
   explicit FacePairSliding(const PairedPointShapes &at_) : at(at_)
   {
      const int vertices = at.Multiplier().Size();
      for (DenseMatrix &component : normals)
      {
         component.SetSize(vertices, 3 * vertices);
         component = 0.0;
      }
      pressure.SetSize(vertices, 3 * at.DestinationDisplacement().Size());
      pressure = 0.0;
      force.SetSize(3 * at.SourceDisplacement().Size(), at.Columns());
      force = 0.0;
   }

   /// @a weights: shape functions of the vertices x area.
   void AddNormal(const Vector &weights)
   {
      for (int v = 0; v < at.Multiplier().Size(); v++)
      {
         for (int e = 0; e < 3; e++)
         {
            const Point3 change = at.NormalChange(v, e);
            for (int c = 0; c < 3; c++)
            {
               for (int j = 0; j < weights.Size(); j++)
               {
                  normals[c](j, 3 * v + e) += weights[j] * change[c];
               }
            }
         }
      }
   }
   /// @a stretch_change: by the displacements of the destination's face.
   void AddPressure(const Vector &weights, const Vector &stretch_change,
                    real_t point_pressure)
   {
      AddMult_a_VWt(point_pressure, weights, stretch_change, pressure);
   }
   /// @a point_force: area x traction.
   void AddForce(const Point3 &point_force)
   {
      const DenseMatrix &slopes = at.SourceDisplacementSlopes();
      along.SetSize(3 * slopes.Height());
      for (int i = 0; i < 2; i++)
      {
         for (int k = 0; k < slopes.Height(); k++)
         {
            for (int d = 0; d < 3; d++)
            {
               along[3 * k + d] = slopes(k, i) * point_force[d];
            }
         }
         at.Row(at.AlongHit()[i], row);
         AddMultVWt(along, row, force);
      }
   }

   void AppendTo(std::array<DisplacementChange, 3> &all_normals,
                 std::vector<Triplet> &all_pressures,
                 DisplacementChange &all_force) const
   {
      const FaceDofs &own = at.DestinationDofs();
      for (int c = 0; c < 3; c++)
      {
         all_normals[c].AppendByNormals(normals[c], own.vertices, at);
      }
      AppendBlock(1.0, pressure, own.vertices, 0, own.displacement,
                  all_pressures);
      all_force.Append(force, at.SourceDofs().displacement, at);
   }

private:
   const PairedPointShapes &at;
   std::array<DenseMatrix, 3> normals;
   DenseMatrix pressure;
   DenseMatrix force;
   Vector row;
   Vector along;
};

/// Change of a face's area per reference area, as a row of its displacements.
class StretchChange
{
public:
   explicit StretchChange(ParFiniteElementSpace &displacement_)
      : displacement(displacement_)
   {
   }
   const Vector &At(const DeformedFace &face, const IntegrationPoint &ip)
   {
      const FiniteElement &element =
         *displacement.FEColl()->FiniteElementForGeometry(face.GetGeometry());
      slopes.SetSize(element.GetDof(), 2);
      element.CalcDShape(ip, slopes);
      const SurfacePoint now = face.Current(ip);
      const Point3 area = now.AreaVector();
      const real_t scale =
         1.0 / (Length(area) * face.Reference(ip).AreaFactor());
      // area . (da_1 x a_2 + a_1 x da_2)
      const Point3 by_first = Cross(now.tangents[1], area);
      const Point3 by_second = Cross(area, now.tangents[0]);
      row.SetSize(3 * slopes.Height());
      for (int k = 0; k < slopes.Height(); k++)
      {
         for (int d = 0; d < 3; d++)
         {
            row[3 * k + d] = scale * (slopes(k, 0) * by_first[d] +
                                      slopes(k, 1) * by_second[d]);
         }
      }
      return row;
   }

private:
   ParFiniteElementSpace &displacement;
   DenseMatrix slopes;
   Vector row;
};
} // namespace

SlidingMaps FiniteGap::FindSlidingMaps() const
{
   const SurfaceVertices &m = pairing.Destination().Vertices();
   std::array<std::vector<Triplet>, 3> distance;
   std::vector<Triplet> pressure;
   std::array<VertexSums, 3> means{VertexSums(m), VertexSums(m), VertexSums(m)};
   PairedPointShapes at(pairing);
   Vector phi;
   for (const PointRange &pair : GroupByFacePair(pairing.Points()))
   {
      at.Evaluate(pair.First());
      const FaceDofs &own = at.DestinationDofs();
      const FaceDofs &other = at.SourceDofs();
      const std::size_t rows = own.vertices.size();
      std::vector<VertexBlock> own_distance(
         3, VertexBlock(rows, own.displacement.size()));
      std::vector<VertexBlock> other_distance(
         3, VertexBlock(rows, other.displacement.size()));
      VertexBlock own_pressure(rows, own.pressure.size());
      for (const PairedPoint &point : pair)
      {
         at.Evaluate(point);
         phi = at.Multiplier();
         phi *= point.area;
         for (int c = 0; c < 3; c++)
         {
            own_distance[c].Add(phi, at.DestinationDisplacement(), axes[c]);
            other_distance[c].Add(phi, at.SourceDisplacement(), axes[c]);
            means[c].Add(at.Vertices(), point.gap * at.Normal()[c], phi);
         }
         phi *= at.Stretch();
         own_pressure.Add(phi, at.DestinationPressure());
      }
      for (int c = 0; c < 3; c++)
      {
         own_distance[c].AppendTo(-1.0, own.vertices, own.displacement,
                                  distance[c]);
         other_distance[c].AppendTo(1.0, own.vertices, other.displacement,
                                    distance[c]);
      }
      own_pressure.AppendTo(1.0, own.vertices, own.pressure, pressure);
   }
   SlidingMaps maps;
   for (int c = 0; c < 3; c++)
   {
      maps.distance[c] = AssembleRows(distance[c], spaces.Displacement());
      maps.mean_distance[c] = means[c].OverRanks();
      rim.Gather(maps.mean_distance[c]);
      maps.mean_distance[c] *= inverse_area;
   }
   maps.pressure = AssembleRows(pressure, spaces.Pressure());
   return maps;
}

SlidingChanges
FiniteGap::FindSlidingChanges(const Vector &p,
                              const VectorByComponent &nodal_force) const
{
   const SurfaceVertices &m = pairing.Destination().Vertices();
   VectorByComponent traction(nodal_force);
   for (Vector &component : traction)
   {
      component *= inverse_area;
      rim.Spread(component);
      component = m.Share(component);
   }
   ParGridFunction pressures(&spaces.Pressure());
   pressures.SetFromTrueDofs(p);

   ParFiniteElementSpace &u = spaces.Displacement();
   std::array<DisplacementChange, 3> by_normal_area;
   std::vector<Triplet> by_pressure;
   DisplacementChange by_force;
   StretchChange stretch(u);
   PairedPointShapes at(pairing);
   Vector phi;
   for (const PointRange &pair : GroupByFacePair(pairing.Points()))
   {
      const DeformedFace &face =
         pairing.Destination().Faces()[pair.First().face];
      at.Evaluate(pair.First());
      FacePairSliding change(at);
      for (const PairedPoint &point : pair)
      {
         at.EvaluateWithSlopes(point);
         phi = at.Multiplier();
         phi *= point.area;
         change.AddNormal(phi);
         change.AddPressure(phi, stretch.At(face, point.ip),
                            Interpolate(at.DestinationPressure(),
                                        face.PressureDofs(), pressures));
         Point3 force;
         for (int c = 0; c < 3; c++)
         {
            force[c] = point.area *
                       Interpolate(at.Multiplier(), at.Vertices(), traction[c]);
         }
         change.AddForce(force);
      }
      change.AppendTo(by_normal_area, by_pressure, by_force);
   }
   const SurfaceNormals &normals = pairing.Normals();
   const auto normals_change = normals.Derivative();
   SlidingChanges changes;
   for (int c = 0; c < 3; c++)
   {
      changes.normal_area[c] = by_normal_area[c].Assemble(
         m.Offsets(), m.GlobalSize(), u, normals, *normals_change);
      rim.Gather(changes.normal_area[c]);
   }
   changes.pressure = AssembleRows(by_pressure, u);
   changes.force = by_force.Assemble(u.GetTrueDofOffsets(), u.GlobalTrueVSize(),
                                     u, normals, *normals_change);
   return changes;
}

} // namespace synovia
