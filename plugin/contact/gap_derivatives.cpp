#include "synovia/contact/gap_derivatives.hpp"
#include "synovia/contact/paired_point_shapes.hpp"
#include "synovia/contact/point_range.hpp"
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

GapDerivatives::GapDerivatives(SurfacePairing &pairing_,
                               const RimVertices &rim_,
                               const Vector &inverse_area_)
   : pairing(pairing_), rim(rim_), inverse_area(inverse_area_)
{
}

void GapDerivatives::Start(const Vector &p, const Vector &nodal_force,
                           const Vector &nodal_flow)
{
   gap.reset();
   jump.reset();
   force.reset();
   outflow.reset();
   by_gap = by_jump = by_force = by_outflow = DisplacementChange();
   pairing.SourceFaces().UpdatePressures(p);
   const auto shared = [&](Vector values)
   {
      values *= inverse_area;
      rim.Spread(values);
      return pairing.Destination().Vertices().Share(values);
   };
   traction = shared(nodal_force);
   flux = shared(nodal_flow);
}

void GapDerivatives::Integrate()
{
   PairedPointShapes at(pairing);
   Vector phi;
   for (const PointRange &pair : GroupByFacePair(pairing.Points()))
   {
      at.Evaluate(pair.First());
      FacePairChange change(at);
      for (const PairedPoint &point : pair)
      {
         at.EvaluateWithSlopes(point);
         const real_t t = Interpolate(at.Multiplier(), at.Vertices(), traction);
         const real_t q = Interpolate(at.Multiplier(), at.Vertices(), flux);
         phi = at.Multiplier();
         phi *= point.area;
         change.AddPoint(phi, point.area * t, point.area * q);
      }
      change.AppendTo(by_gap, by_jump, by_force, by_outflow);
   }
}

void GapDerivatives::Assemble()
{
   BiphasicSpaces &spaces = pairing.Destination().Spaces();
   const auto normals_change = pairing.Normals().Derivative();
   // The largest first, which leaves room for the others.
   force = AssembleByDof(by_force, spaces.Displacement(), *normals_change);
   gap = AssembleByVertex(by_gap, *normals_change);
   jump = AssembleByVertex(by_jump, *normals_change);
   outflow = AssembleByDof(by_outflow, spaces.Pressure(), *normals_change);
}

std::unique_ptr<HypreParMatrix>
GapDerivatives::AssembleByVertex(DisplacementChange &change,
                                 const HypreParMatrix &normals_change) const
{
   const ContactSurface &destination = pairing.Destination();
   const SurfaceVertices &m = destination.Vertices();
   auto matrix = change.Assemble(m.Offsets(), m.GlobalSize(),
                                 destination.Spaces().Displacement(),
                                 pairing.Normals(), normals_change);
   rim.Gather(matrix);
   matrix->ScaleRows(inverse_area);
   return matrix;
}

std::unique_ptr<HypreParMatrix>
GapDerivatives::AssembleByDof(DisplacementChange &change,
                              ParFiniteElementSpace &rows,
                              const HypreParMatrix &normals_change) const
{
   return change.Assemble(rows.GetTrueDofOffsets(), rows.GlobalTrueVSize(),
                          pairing.Destination().Spaces().Displacement(),
                          pairing.Normals(), normals_change);
}

} // namespace synovia
