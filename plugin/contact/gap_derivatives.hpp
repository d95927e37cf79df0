#pragma once

#include "synovia/contact/displacement_change.hpp"
#include "synovia/contact/rim_vertices.hpp"

#include <memory>

namespace synovia
{

/// Derivatives of a FiniteGap by the displacement, as ContactFactors has them,
/// where its points are.
///
/// They are made in three steps, of which the second, by far the longest, is
/// each rank's own. With several pairs all of them take each step before the
/// next one: pairs are spread unevenly over ranks, and with one after the other
/// those ranks that have little of a pair would wait for those that have much.
class GapDerivatives
{
public:
   /// Borrows all of them. @a inverse_area: 1 / a_j of FiniteGap, 0 where
   /// nothing is hit.
   GapDerivatives(SurfacePairing &pairing, const RimVertices &rim,
                  const mfem::Vector &inverse_area);

   /// For pressures @a p (true dofs), nodal forces area x traction and nodal
   /// flows area x flux. The derivatives that were there are gone. Collective.
   void Start(const mfem::Vector &p, const mfem::Vector &nodal_force,
              const mfem::Vector &nodal_flow);
   /// Sums over this rank's points; not collective.
   void Integrate();
   /// Collective.
   void Assemble();

   const mfem::HypreParMatrix &Gap() const { return *gap; }
   const mfem::HypreParMatrix &Jump() const { return *jump; }
   const mfem::HypreParMatrix &Force() const { return *force; }
   const mfem::HypreParMatrix &Outflow() const { return *outflow; }

private:
   /// A row a vertex of the destination.
   std::unique_ptr<mfem::HypreParMatrix>
   AssembleByVertex(DisplacementChange &change,
                    const mfem::HypreParMatrix &normals_change) const;
   /// A row a dof.
   std::unique_ptr<mfem::HypreParMatrix>
   AssembleByDof(DisplacementChange &change, mfem::ParFiniteElementSpace &rows,
                 const mfem::HypreParMatrix &normals_change) const;

   SurfacePairing &pairing;
   const RimVertices &rim;
   const mfem::Vector &inverse_area;
   /// At this rank's vertices, shared ones included.
   mfem::Vector traction;
   mfem::Vector flux;
   DisplacementChange by_gap;
   DisplacementChange by_jump;
   DisplacementChange by_force;
   DisplacementChange by_outflow;
   std::unique_ptr<mfem::HypreParMatrix> gap;
   std::unique_ptr<mfem::HypreParMatrix> jump;
   std::unique_ptr<mfem::HypreParMatrix> force;
   std::unique_ptr<mfem::HypreParMatrix> outflow;
};

} // namespace synovia
