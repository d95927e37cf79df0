#pragma once

#include "synovia/contact/surface_pairing.hpp"

#include <vector>

namespace synovia
{

/// The ingredients of the gap at a point and of its derivatives: shape
/// functions on both faces and the frame of normal and tangents.
///
/// With s = dx_A - dx_B - gap dn at fixed reference coordinates of the hit,
///
///     dgap = along_gap . s,     dxi_i = along_hit[i] . s
///
/// Large because it names each of these values.
class PairedPointShapes
{
public:
   /// Borrows @a pairing.
   explicit PairedPointShapes(const SurfacePairing &pairing);

   /// Goes to another point: values only, or with derivatives.
   void Evaluate(const PairedPoint &point);
   void EvaluateWithSlopes(const PairedPoint &point);

   /// Dofs of displacement, pressure and multiplier on either face.
   const FaceDofs &SourceDofs() const { return source->dofs; }
   const FaceDofs &DestinationDofs() const { return destination; }
   const std::vector<HYPRE_BigInt> &NormalRows() const { return normal_rows; }
   /// Local vertices of the destination's face.
   const mfem::Array<int> &Vertices() const { return face->Vertices(); }

   /// Current area per reference area, of the destination and of the source.
   mfem::real_t Stretch() const { return stretch; }
   mfem::real_t SourceStretch() const;
   const Point3 &Normal() const { return normal; }
   const mfem::Vector &SourceDisplacement() const { return source_u; }
   const mfem::Vector &SourcePressure() const { return source_p; }
   const mfem::Vector &SourceMultiplier() const { return source_m; }
   const mfem::Vector &DestinationDisplacement() const { return u; }
   const mfem::Vector &DestinationPressure() const { return p; }
   const mfem::Vector &VertexShapes() const { return m; }
   /// What the multipliers of the vertices have there: ShareOf() the
   /// vertices' shape functions.
   const mfem::Vector &Multiplier() const { return multiplier; }

   /// Nodes of the source's face x 2: by xi and eta.
   const mfem::DenseMatrix &SourceDisplacementSlopes() const
   {
      return source_du;
   }
   const mfem::DenseMatrix &SourcePressureSlopes() const { return source_dp; }
   /// Of the source's pressure, by xi and eta (stress).
   const std::array<mfem::real_t, 2> &PressureSlopes() const
   {
      return pressure_slopes;
   }
   const Point3 &AlongGap() const { return along_gap; }
   const std::array<Point3, 2> &AlongHit() const { return along_hit; }

   /// Columns of Row(): displacements of the source's face and of the
   /// destination's face, and the vertices' normals.
   int Columns() const;
   int DisplacementColumns() const;
   /// along . s as a row.
   void Row(const Point3 &along, mfem::Vector &row) const;
   /// Changes of the unit normal with the components of the interpolated one.
   std::array<Point3, 3> NormalTurn() const;
   /// Change of the unit normal with component @a d of a vertex's.
   Point3 NormalChange(int vertex, int d) const;

private:
   const mfem::FiniteElement &Element(const mfem::ParFiniteElementSpace &space,
                                      mfem::Geometry::Type geometry) const
   {
      return *space.FEColl()->FiniteElementForGeometry(geometry);
   }
   void GoToFace(int number);
   /// Of the spaces, at a point of a face.
   void SetShapes(mfem::Geometry::Type geometry,
                  const mfem::IntegrationPoint &ip, mfem::Vector &displacement,
                  mfem::Vector &pressure, mfem::Vector &of_vertices) const;

   const SurfacePairing &pairing;
   BiphasicSpaces &spaces;
   int face_number = -1;
   const DeformedFace *face = nullptr;
   const HaloFace *source = nullptr;
   FaceDofs destination;
   std::vector<HYPRE_BigInt> normal_rows;
   mfem::IntegrationPoint hit;
   mfem::real_t gap = 0.0;
   mfem::real_t stretch = 1.0;
   Point3 normal;
   /// Of the interpolated normal, before it was made a unit vector.
   mfem::real_t normal_length = 1.0;
   mfem::Vector source_u;
   mfem::Vector source_p;
   mfem::Vector source_m;
   mfem::Vector u;
   mfem::Vector p;
   mfem::Vector m;
   mfem::Vector multiplier;
   mfem::DenseMatrix source_du;
   mfem::DenseMatrix source_dp;
   std::array<mfem::real_t, 2> pressure_slopes;
   Point3 along_gap;
   std::array<Point3, 2> along_hit;
};

} // namespace synovia
