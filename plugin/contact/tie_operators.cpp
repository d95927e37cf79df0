#include "synovia/contact/tie_operators.hpp"
#include "synovia/contact/paired_point_shapes.hpp"
#include "synovia/contact/point_range.hpp"
#include "synovia/contact/rim_vertices.hpp"
#include "synovia/contact/vertex_blocks.hpp"
#include "synovia/general/reduce.hpp"

#include <algorithm>
#include <cmath>

namespace synovia
{

using namespace mfem;

namespace
{
constexpr std::array<Point3, 3> components{
   {{{1.0, 0.0, 0.0}}, {{0.0, 1.0, 0.0}}, {{0.0, 0.0, 1.0}}}};

Vector Marked(int size, const std::vector<const Array<int> *> &lists)
{
   Vector marks(size);
   marks = 0.0;
   for (const Array<int> *list : lists)
   {
      for (const int dof : *list)
      {
         marks[dof] = 1.0;
      }
   }
   return marks;
}

/// 1 for the destination's vertices whose displacement is among the marked true
/// dofs, by component.
VectorByComponent MarkedVertices(const ContactSurface &destination,
                                 const Vector &marks)
{
   ParGridFunction at_dofs(&destination.Spaces().Displacement());
   at_dofs.SetFromTrueDofs(marks);
   at_dofs.HostRead();
   const SurfaceVertices &m = destination.Vertices();
   VectorByComponent local;
   for (Vector &component : local)
   {
      component.SetSize(m.LocalSize());
      component = 0.0;
   }
   for (const DeformedFace &face : destination.Faces())
   {
      for (int j = 0; j < face.Vertices().Size(); j++)
      {
         for (int c = 0; c < 3; c++)
         {
            // A face's first nodes are its vertices.
            local[c][face.Vertices()[j]] =
               at_dofs[face.DisplacementDofs()[3 * j + c]];
         }
      }
   }
   VectorByComponent own;
   for (int c = 0; c < 3; c++)
   {
      own[c] = m.SumShared(local[c]);
      for (real_t &mark : own[c])
      {
         mark = mark > 0.0 ? 1.0 : 0.0;
      }
   }
   return own;
}

/// What the points of a pairing add up to, by shape functions of vertices.
struct TieSums
{
   explicit TieSums(const SurfacePairing &pairing);

   std::array<std::vector<Triplet>, 3> jump;
   std::vector<Triplet> pressure_jump;
   Vector area;
   Vector face_size;
   real_t distance = 0.0;
};

TieSums::TieSums(const SurfacePairing &pairing)
{
   const SurfaceVertices &m = pairing.Destination().Vertices();
   VertexSums areas(m);
   VertexSums sizes(m);
   PairedPointShapes at(pairing);
   Vector phi;
   for (const PointRange &pair : GroupByFacePair(pairing.Points()))
   {
      at.Evaluate(pair.First());
      const FaceDofs &own = at.DestinationDofs();
      const FaceDofs &other = at.SourceDofs();
      const std::size_t rows = own.vertices.size();
      std::vector<VertexBlock> own_jump(
         3, VertexBlock(rows, own.displacement.size()));
      std::vector<VertexBlock> other_jump(
         3, VertexBlock(rows, other.displacement.size()));
      VertexBlock own_pressure(rows, own.pressure.size());
      VertexBlock other_pressure(rows, other.pressure.size());
      for (const PairedPoint &point : pair)
      {
         at.Evaluate(point);
         phi = at.Multiplier();
         phi *= point.area;
         for (int c = 0; c < 3; c++)
         {
            own_jump[c].Add(phi, at.DestinationDisplacement(), components[c]);
            other_jump[c].Add(phi, at.SourceDisplacement(), components[c]);
         }
         own_pressure.Add(phi, at.DestinationPressure());
         other_pressure.Add(phi, at.SourcePressure());
         areas.Add(at.Vertices(), 1.0, phi);
         distance = std::max(distance, std::abs(point.gap));
      }
      for (int c = 0; c < 3; c++)
      {
         own_jump[c].AppendTo(-1.0, own.vertices, own.displacement, jump[c]);
         other_jump[c].AppendTo(1.0, own.vertices, other.displacement, jump[c]);
      }
      own_pressure.AppendTo(-1.0, own.vertices, own.pressure, pressure_jump);
      other_pressure.AppendTo(1.0, own.vertices, other.pressure, pressure_jump);
   }
   for (const PointRange &on_face : GroupByFace(pairing.Points()))
   {
      real_t hit = 0.0;
      for (const PairedPoint &point : on_face)
      {
         hit += point.area;
      }
      for (const PairedPoint &point : on_face)
      {
         at.Evaluate(point);
         phi = at.Multiplier();
         phi *= point.area;
         const bool square = at.DestinationDofs().geometry == Geometry::SQUARE;
         sizes.Add(at.Vertices(), std::sqrt((square ? 1.0 : 2.0) * hit), phi);
      }
   }
   area = areas.OverRanks();
   face_size = sizes.OverRanks();
}

/// The rows of one field, as means of the functions of its multipliers.
class TieRows
{
public:
   /// @a without: 1 for the vertices that have no multiplier.
   TieRows(const SurfacePairing &pairing_, const Vector &vertex_areas,
           const Vector &covered, const Vector &without)
      : pairing(pairing_), rim(pairing.Destination(), vertex_areas, 0.0)
   {
      rim.UpdateThose(pairing, without);
      area = covered;
      rim.Gather(area);
   }

   /// Takes rows out that have no entry but for @a prescribed ones, 1 there.
   std::unique_ptr<HypreParMatrix> Assemble(const std::vector<Triplet> &entries,
                                            ParFiniteElementSpace &columns,
                                            const Vector &prescribed)
   {
      constexpr real_t tiny = 1e-10;
      const SurfaceVertices &m = pairing.Destination().Vertices();
      auto matrix = AssembleTriplets(
         columns.GetComm(), entries, m.Offsets(), m.GlobalSize(),
         columns.GetTrueDofOffsets(), columns.GlobalTrueVSize());
      rim.Gather(matrix);
      Vector free(prescribed.Size());
      for (int i = 0; i < free.Size(); i++)
      {
         free[i] = 1.0 - prescribed[i];
      }
      Vector movable(area.Size());
      matrix->AbsMult(1.0, free, 0.0, movable);
      movable.HostRead();
      Vector inverse(area.Size());
      for (int j = 0; j < area.Size(); j++)
      {
         area[j] = movable[j] > tiny * area[j] ? area[j] : 0.0;
         inverse[j] = area[j] > 0.0 ? 1.0 / area[j] : 0.0;
      }
      matrix->ScaleRows(inverse);
      return matrix;
   }

   Vector area;

private:
   const SurfacePairing &pairing;
   RimVertices rim;
};
} // namespace

TieOperators AssembleTieOperators(const ContactSurface &source,
                                  const ContactSurface &destination,
                                  const Vector &areas,
                                  const GapOptions &options,
                                  const TieHolds &holds, bool exchange)
{
   BiphasicSpaces &spaces = destination.Spaces();
   MPI_Comm comm = spaces.GetComm();
   const SurfaceVertices &m = destination.Vertices();
   SurfacePairing pairing(source, destination, options);
   pairing.Segment();
   const TieSums sums(pairing);

   TieOperators operators;
   operators.distance = MaxOverRanks(sums.distance, comm);
   operators.covered =
      SumOverRanks(sums.area.Sum(), comm) / SumOverRanks(areas.Sum(), comm);
   operators.face_size = sums.face_size;
   Vector slivers(m.Size());
   for (int j = 0; j < m.Size(); j++)
   {
      operators.face_size[j] /= sums.area[j] > 0.0 ? sums.area[j] : 1.0;
      slivers[j] = sums.area[j] < options.rim_coverage * areas[j] ? 1.0 : 0.0;
   }
   const auto also = [](const Vector &a, Vector b)
   {
      for (int j = 0; j < b.Size(); j++)
      {
         b[j] = std::max(a[j], b[j]);
      }
      return b;
   };

   const int displacements = spaces.Displacement().GetTrueVSize();
   const Vector prescribed = Marked(displacements, {&holds.prescribed});
   const VectorByComponent held = MarkedVertices(
      destination, Marked(displacements, {&holds.prescribed, &holds.moved}));
   for (int c = 0; c < 3; c++)
   {
      TieRows rows(pairing, areas, sums.area, also(slivers, held[c]));
      operators.jump[c] =
         rows.Assemble(sums.jump[c], spaces.Displacement(), prescribed);
      operators.area[c] = rows.area;
   }

   const int pressures = spaces.Pressure().GetTrueVSize();
   operators.no_jump = AssembleTriplets(comm, {}, m.Offsets(), m.GlobalSize(),
                                        spaces.Pressure().GetTrueDofOffsets(),
                                        spaces.Pressure().GlobalTrueVSize());
   Vector drained(m.Size());
   drained = 0.0;
   for (const Array<int> *list :
        {&holds.prescribed_pressures, &holds.moved_pressures})
   {
      for (const int vertex : spaces.VerticesAmong(*list))
      {
         const int j = m.TrueDofs().FindSorted(vertex);
         if (j >= 0)
         {
            drained[j] = 1.0;
         }
      }
   }
   TieRows rows(pairing, areas, sums.area, also(slivers, drained));
   operators.pressure_jump = rows.Assemble(
      exchange ? sums.pressure_jump : std::vector<Triplet>(), spaces.Pressure(),
      Marked(pressures, {&holds.prescribed_pressures}));
   operators.pressure_area = rows.area;
   return operators;
}

} // namespace synovia
