#pragma once

#include "synovia/fem/tie_map.hpp"
#include "synovia/general/vector_entries.hpp"
#include "synovia/linalg/reduced_contact.hpp"

namespace synovia
{

/// The linearized equations of one stage, for (displacement, pressure), the
/// former reduced by RigidSurfaces where there are any:
///
///     [ K + G^T W R + F                  -B^T + H        ]
///     [ -(B + dt (J^T W_p J_u + O))  -(dt L + S + dt J^T W_p J) ]
///
/// with unit rows and columns for prescribed dofs, and with the
/// ContactFactors G, R, F = force_change, H = force_by_pressure, J, J_u =
/// jump_change and O = outflow_change, of which R is G, and F, H, J_u and O are
/// zero, in infinitesimal contact. It is symmetric and quasi-definite then, K,
/// B, L, S constant for linear bodies; contact acts through its factors, so
/// that a change of the active set costs nothing here. In finite deformation
/// the matrices follow the state, and B in the second row has the change of the
/// flow beside it.
///
/// Where surfaces are tied to rigid bodies, the equations are those of
/// TieTangent: the slots of its free freedoms are unknowns, all other tied dofs
/// count as prescribed. The parts, such as DisplacementBlock(), hold all tied
/// dofs, slots included.
///
/// Large because preconditioners ask for its parts, each in another way.
class BiphasicJacobian : public mfem::Operator
{
public:
   /// Borrows all arguments but @a u_dofs, the prescribed true dofs. The idle
   /// dofs of @a rigid, null where nothing is driven, count as prescribed.
   /// @a ties is null where nothing is tied. The factors of @a contact may be
   /// set later, with a call of ContactChanged().
   BiphasicJacobian(const VolumeMatrices &matrices,
                    const mfem::Array<int> &offsets,
                    const mfem::Array<int> &u_dofs, const ContactTerms &contact,
                    const RigidSurfaces *rigid = nullptr,
                    const TieTangent *ties = nullptr);

   /// To be called when contact factors were replaced or have other entries;
   /// not when only weights have changed. Collective.
   void ContactChanged();

   /// To be called when the bodies' matrices have changed. Collective.
   void BodiesChanged();

   /// Collective.
   void SetTimeStep(mfem::real_t dt);
   mfem::real_t TimeStep() const { return dt; }
   /// Prescribed and free-draining true dofs of the pressure, ascending.
   void SetPressureDofs(const mfem::Array<int> &p_dofs_) { p_dofs = p_dofs_; }

   void Mult(const mfem::Vector &x, mfem::Vector &y) const override;

   /// y += (B + dt (J^T W_p J_u + O)) x: the mass of a displacement x that is
   /// zero at prescribed dofs.
   void AddMassOfDisplacement(const mfem::Vector &x, mfem::Vector &y) const;

   /// dt L + S + c M / H_A with unit rows and columns for some @a dofs: an
   /// approximation of the negative Schur complement without contact. c is
   /// @a compliance: B K^-1 B^T is at most M / H_A.
   std::unique_ptr<mfem::HypreParMatrix>
   SchurComplement(const mfem::Array<int> &dofs, mfem::real_t compliance) const;

   /// Diagonal entries, by true dof of the pressure, that hold it near zero in
   /// a preconditioner: @a large times those of the flow. They depend on the
   /// time step.
   mfem::Vector Holding(mfem::real_t large) const;
   /// The whole matrix, assembled, with unit rows for prescribed displacements
   /// and -@a holding on the diagonal for prescribed pressures. Where contact
   /// is symmetric it may be treated as symmetric: the bodies' part nearly is,
   /// and its coupling blocks are each other's transpose. Freedoms of rigid
   /// bodies have their slots, with @a support as in TieMap::Stiffness().
   std::unique_ptr<mfem::HypreParMatrix>
   AssembleHeld(const mfem::Vector &holding, mfem::real_t support) const;
   /// The map to which AssembleHeld() belongs; null where nothing is tied.
   /// Collective.
   std::unique_ptr<TieMap> MakeTieMap() const;

   const mfem::Array<int> &Offsets() const { return offsets; }
   /// Prescribed and tied ones.
   const mfem::Array<int> &DisplacementDofs() const { return OnHost(u_dofs); }
   /// Prescribed ones that aren't tied.
   const mfem::Array<int> &PrescribedDofs() const
   {
      return OnHost(prescribed_dofs);
   }
   const mfem::Array<int> &PressureDofs() const { return OnHost(p_dofs); }
   /// Of all pairs, for reduced displacements.
   const ContactTerms &Contact() const { return contact.Terms(); }
   const VolumeMatrices &Volume() const { return matrices; }
   /// Null where nothing is tied.
   const TieTangent *Ties() const { return ties; }
   bool IsContactSymmetric() const;

   /// The terms of K + sum F, the bodies and the tractions that follow their
   /// surfaces. A fluid's pressure in the bodies and the contact traction that
   /// holds it are of one size and opposite signs there: apart from each other
   /// they are far from definite.
   std::vector<const mfem::HypreParMatrix *> StiffnessUnderTraction() const;

   /// K + sum (F + G^T W G), with other @a weights W of the gaps, F as
   /// ContactFactors::soft_force_change has it, and unit rows and columns for
   /// the prescribed dofs: symmetric if K is and there is no F.
   /// Collective.
   std::unique_ptr<mfem::HypreParMatrix>
   DisplacementBlock(const std::vector<mfem::Vector> &weights) const;

private:
   /// Of the matrices that a product reads, contact's apart.
   double BytesOfBodies() const;
   using Matrix = mfem::HypreParMatrix;

   /// sum F, or null where no pair has it.
   std::unique_ptr<Matrix> ForceChange() const;
   /// K + @a contact_terms, which may be null.
   std::unique_ptr<Matrix>
   AddToBodies(std::unique_ptr<Matrix> contact_terms) const;
   /// Gives prescribed dofs unit rows and columns.
   void Eliminate(const mfem::Array<int> &dofs, Matrix &block) const;
   /// K + sum (G^T W R + F) by @a map, if any, with unit rows and columns.
   std::unique_ptr<Matrix> MomentumBlock(const TieMap *map,
                                         mfem::real_t support) const;
   /// B + dt (J^T W_p J_u + O), with zero columns for prescribed dofs.
   std::unique_ptr<Matrix> CouplingBlock(const TieMap *map) const;
   /// dt L + S + dt J^T W_p J
   std::unique_ptr<Matrix> PressureBlock() const;
   /// y += contact's (G^T W R + F) u + H p
   void AddContactForces(const mfem::Vector &u, const mfem::Vector &p,
                         mfem::Vector &y) const;
   /// B^T - sum H, with zero rows for prescribed dofs.
   std::unique_ptr<Matrix> LoadBlock(const TieMap *map) const;
   /// y += scale x contact's mass of a displacement and a pressure, of which
   /// either may be null.
   void AddContactMass(mfem::real_t scale, const mfem::Vector *u,
                       const mfem::Vector *p, mfem::Vector &y) const;

   const VolumeMatrices &original;
   std::unique_ptr<VolumeMatrices> reduced;
   const VolumeMatrices &matrices;
   const mfem::Array<int> &offsets;
   mfem::Array<int> prescribed_dofs;
   mfem::Array<int> u_dofs;
   const RigidSurfaces *rigid;
   const TieTangent *ties;
   ReducedContact contact;
   mfem::Array<int> p_dofs;
   mfem::real_t dt = 0.0;
   /// dt L + S
   std::unique_ptr<mfem::HypreParMatrix> flow;
   mutable mfem::Vector u_free;
   mutable mfem::Vector p_free;
   mutable mfem::Vector rows;
   mutable mfem::Vector product;
};

/// left^T diag(weights) right
std::unique_ptr<mfem::HypreParMatrix>
WeightedProduct(const mfem::HypreParMatrix &left, const mfem::Vector &weights,
                const mfem::HypreParMatrix &right);

/// Adds a matrix to @a sum, null at first. Collective.
void AddTo(std::unique_ptr<mfem::HypreParMatrix> &sum,
           std::unique_ptr<mfem::HypreParMatrix> term);

} // namespace synovia
