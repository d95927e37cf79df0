#include "synovia/contact/displacement_change.hpp"
#include "synovia/contact/finite_gap.hpp"
#include "synovia/contact/paired_point_shapes.hpp"
#include "synovia/contact/vertex_blocks.hpp"

namespace synovia
{

using namespace mfem;

namespace
{
/// What the points on one pair of faces add.
class FacePairChange
{
public:
   explicit FacePairChange(const PairedPointShapes &at_) : at(at_)
   {
      const int vertices = at.Multiplier().Size();
      const int columns = at.Columns();
      Clear(gap, vertices, columns);
      Clear(jump, vertices, columns);
      Clear(force, 3 * at.SourceDisplacement().Size(), columns);
      Clear(outflow, at.SourcePressure().Size(), columns);
      Clear(force_by_normals, 3 * at.SourceDisplacement().Size(), 3 * vertices);
      Clear(own_force_by_normals, 3 * at.DestinationDisplacement().Size(),
            3 * vertices);
   }

   /// @a weights: shape functions of the vertices x area. @a force and @a flow
   /// of the point: area x traction and area x flux.
   void AddPoint(const Vector &weights, real_t point_force, real_t point_flow)
   {
      at.Row(at.AlongGap(), row);
      AddMultVWt(weights, row, gap);
      for (int i = 0; i < 2; i++)
      {
         at.Row(at.AlongHit()[i], row);
         AddMult_a_VWt(at.PressureSlopes()[i], weights, row, jump);
         if (point_flow != 0.0)
         {
            at.SourcePressureSlopes().GetColumn(i, slope);
            AddMult_a_VWt(point_flow, slope, row, outflow);
         }
         if (point_force != 0.0)
         {
            at.SourceDisplacementSlopes().GetColumn(i, slope);
            SetAlongNormal(slope);
            AddMult_a_VWt(point_force, along_normal, row, force);
         }
      }
      if (point_force != 0.0)
      {
         const std::array<Point3, 3> turn = at.NormalTurn();
         AddTurn(point_force, turn, at.SourceDisplacement(), force_by_normals);
         AddTurn(-point_force, turn, at.DestinationDisplacement(),
                 own_force_by_normals);
      }
   }

   void AppendTo(DisplacementChange &all_gap, DisplacementChange &all_jump,
                 DisplacementChange &all_force,
                 DisplacementChange &all_outflow) const
   {
      const FaceDofs &own = at.DestinationDofs();
      const FaceDofs &other = at.SourceDofs();
      all_gap.Append(gap, own.vertices, at);
      all_jump.Append(jump, own.vertices, at);
      all_force.Append(force, other.displacement, at);
      all_outflow.Append(outflow, other.pressure, at);
      all_force.AppendByNormals(force_by_normals, other.displacement, at);
      all_force.AppendByNormals(own_force_by_normals, own.displacement, at);
   }

private:
   static void Clear(DenseMatrix &matrix, int rows, int columns)
   {
      matrix.SetSize(rows, columns);
      matrix = 0.0;
   }
   void SetAlongNormal(const Vector &shape)
   {
      along_normal.SetSize(3 * shape.Size());
      for (int k = 0; k < shape.Size(); k++)
      {
         for (int d = 0; d < 3; d++)
         {
            along_normal[3 * k + d] = shape[k] * at.Normal()[d];
         }
      }
   }
   /// A force that turns with the normal.
   void AddTurn(real_t size, const std::array<Point3, 3> &turn,
                const Vector &shape, DenseMatrix &by_normals) const
   {
      const Vector &m = at.VertexShapes();
      for (int v = 0; v < m.Size(); v++)
      {
         for (int e = 0; e < 3; e++)
         {
            real_t *const column = by_normals.GetColumn(3 * v + e);
            for (int k = 0; k < shape.Size(); k++)
            {
               const real_t share = size * m[v] * shape[k];
               for (int d = 0; d < 3; d++)
               {
                  column[3 * k + d] += share * turn[e][d];
               }
            }
         }
      }
   }

   const PairedPointShapes &at;
   DenseMatrix gap;
   DenseMatrix jump;
   DenseMatrix force;
   DenseMatrix outflow;
   DenseMatrix force_by_normals;
   DenseMatrix own_force_by_normals;
   Vector row;
   Vector slope;
   Vector along_normal;
};
} // namespace

void FiniteGap::Linearize(const Vector &p, const Vector &nodal_force,
                          const Vector &nodal_flow)
{
   const SurfaceVertices &m = pairing.Destination().Vertices();
   pairing.SourceFaces().UpdatePressures(p);
   force_change.reset();
   gap_change.reset();
   jump_change.reset();
   outflow_change.reset();
   Vector traction(nodal_force);
   Vector flux(nodal_flow);
   traction *= inverse_area;
   flux *= inverse_area;
   rim.Spread(traction);
   rim.Spread(flux);
   traction = m.Share(traction);
   flux = m.Share(flux);

   DisplacementChange by_gap;
   DisplacementChange by_jump;
   DisplacementChange by_force;
   DisplacementChange by_outflow;
   PairedPointShapes at(pairing);
   Vector phi;
   const std::vector<PairedPoint> &points = pairing.Points();
   for (std::size_t begin = 0, end = 0; begin < points.size(); begin = end)
   {
      const PairedPoint &first = points[begin];
      at.Evaluate(first);
      FacePairChange change(at);
      for (; end < points.size() && points[end].face == first.face &&
             points[end].source == first.source;
           end++)
      {
         const PairedPoint &point = points[end];
         at.EvaluateWithSlopes(point);
         const real_t t = Interpolate(at.Multiplier(), at.Vertices(), traction);
         const real_t q = Interpolate(at.Multiplier(), at.Vertices(), flux);
         phi = at.Multiplier();
         phi *= point.area;
         change.AddPoint(phi, point.area * t, point.area * q);
      }
      change.AppendTo(by_gap, by_jump, by_force, by_outflow);
   }
   const SurfaceNormals &normals = pairing.Normals();
   const auto normals_change = normals.Derivative();
   ParFiniteElementSpace &u = spaces.Displacement();
   const auto by_vertex = [&](DisplacementChange &change)
   {
      auto matrix = change.Assemble(m.Offsets(), m.GlobalSize(), u, normals,
                                    *normals_change);
      rim.Gather(matrix);
      matrix->ScaleRows(inverse_area);
      return matrix;
   };
   const auto by_dof =
      [&](DisplacementChange &change, ParFiniteElementSpace &rows)
   {
      return change.Assemble(rows.GetTrueDofOffsets(), rows.GlobalTrueVSize(),
                             u, normals, *normals_change);
   };
   // The largest first, which leaves room for the others.
   force_change = by_dof(by_force, u);
   gap_change = by_vertex(by_gap);
   jump_change = by_vertex(by_jump);
   outflow_change = by_dof(by_outflow, spaces.Pressure());
}

} // namespace synovia
