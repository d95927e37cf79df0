#pragma once

#include "synovia/contact/contact_pair.hpp"
#include "synovia/fem/rigid_surfaces.hpp"
#include "synovia/general/vector_entries.hpp"

#include <vector>

namespace synovia
{

/// Contact pairs of a problem; borrowed.
using ContactPairs = std::vector<const ContactPair *>;

/// The linearized equations of one stage, for (displacement, pressure), the
/// former reduced by RigidSurfaces where there are any:
///
///     [ K + G^T W G       -B^T                      ]
///     [    -B       -(dt L + S + dt J^T W_p J)      ]
///
/// with unit rows and columns for prescribed dofs. Symmetric and
/// quasi-definite, K, B, L, S constant for linear bodies; contact acts through
/// its factors, so that a change of the active set costs nothing here. In
/// finite deformation the matrices follow the state, and -B in the second row
/// has the change of the flow with the deformation beside it.
class BiphasicJacobian : public mfem::Operator
{
public:
   /// Borrows all arguments but @a u_dofs, the prescribed true dofs. The idle
   /// dofs of @a rigid, null where nothing is driven, count as prescribed.
   BiphasicJacobian(const VolumeMatrices &matrices,
                    const mfem::Array<int> &offsets,
                    const mfem::Array<int> &u_dofs, const ContactPairs &pairs,
                    const RigidSurfaces *rigid = nullptr);

   /// Surfaces were searched anew: gap and jump have other entries. Collective.
   void ContactMoved();

   /// The bodies' matrices are others. Collective.
   void BodiesChanged();

   /// Collective.
   void SetTimeStep(mfem::real_t dt);
   mfem::real_t TimeStep() const { return dt; }
   /// Prescribed and free-draining true dofs of the pressure, ascending.
   void SetPressureDofs(const mfem::Array<int> &p_dofs_) { p_dofs = p_dofs_; }

   void Mult(const mfem::Vector &x, mfem::Vector &y) const override;

   /// y = (K + G^T W G) x with unit rows for prescribed dofs.
   void MultDisplacement(const mfem::Vector &x, mfem::Vector &y) const;
   /// y += B x for x with zeros at prescribed dofs.
   void AddDivergence(const mfem::Vector &x, mfem::Vector &y) const;

   /// dt L + S + c M / H_A with unit rows and columns for some @a dofs: an
   /// approximation of the Schur complement, less its sign, but for the
   /// contact.
   std::unique_ptr<mfem::HypreParMatrix>
   SchurComplement(const mfem::Array<int> &dofs) const;

   /// Weights by true dof of the pressure that, on the diagonal, hold it at
   /// zero for all that a preconditioner needs. They depend on the time step.
   mfem::Vector Holding() const;
   /// The whole matrix, assembled, with unit rows for prescribed displacements
   /// and -@a holding on the diagonal for prescribed pressures.
   std::unique_ptr<mfem::HypreParMatrix>
   AssembleHeld(const mfem::Vector &holding) const;

   const mfem::Array<int> &Offsets() const { return offsets; }
   const mfem::Array<int> &DisplacementDofs() const { return OnHost(u_dofs); }
   const mfem::Array<int> &PressureDofs() const { return OnHost(p_dofs); }
   const ContactPairs &Pairs() const { return pairs; }
   /// Gap operator G of a pair, for reduced displacements.
   const mfem::HypreParMatrix &Gap(std::size_t pair) const
   {
      return reduced_gaps.empty() ? *pairs[pair]->Factors().gap
                                  : *reduced_gaps[pair];
   }
   const VolumeMatrices &Volume() const { return matrices; }

   /// K + sum G^T W G, with the pairs' @a weights W of their gaps, and unit
   /// rows and columns for the prescribed dofs. Collective.
   std::unique_ptr<mfem::HypreParMatrix>
   DisplacementBlock(const std::vector<mfem::Vector> &weights) const;

private:
   /// dt L + S + dt J^T W_p J
   std::unique_ptr<mfem::HypreParMatrix> PressureBlock() const;
   void AddContact(const mfem::HypreParMatrix &factor,
                   const mfem::Vector &weights, mfem::real_t scale,
                   const mfem::Vector &x, mfem::Vector &y) const;

   const VolumeMatrices &original;
   std::unique_ptr<VolumeMatrices> reduced;
   const VolumeMatrices &matrices;
   const mfem::Array<int> &offsets;
   mfem::Array<int> u_dofs;
   const ContactPairs &pairs;
   const RigidSurfaces *rigid;
   std::vector<std::unique_ptr<mfem::HypreParMatrix>> reduced_gaps;
   mfem::Array<int> p_dofs;
   mfem::real_t dt = 0.0;
   /// dt L + S
   std::unique_ptr<mfem::HypreParMatrix> flow;
   mutable mfem::Vector u_free;
   mutable mfem::Vector p_free;
   mutable mfem::Vector rows;
   mutable mfem::Vector product;
};

/// factor^T diag(weights) factor
std::unique_ptr<mfem::HypreParMatrix>
WeightedSquare(const mfem::HypreParMatrix &factor, const mfem::Vector &weights);

/// Adds factor^T diag(weights) factor to @a sum, null at first. Collective.
void AddWeightedSquare(const mfem::HypreParMatrix &factor,
                       const mfem::Vector &weights,
                       std::unique_ptr<mfem::HypreParMatrix> &sum);

} // namespace synovia
