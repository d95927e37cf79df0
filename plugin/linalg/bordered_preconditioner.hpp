#pragma once

#include "synovia/linalg/biphasic_linear_solver.hpp"

#include <functional>

namespace synovia
{

/// Adds the free freedoms of rigid bodies to a preconditioner of the equations
/// with all tied dofs held.
///
/// What the tied nodes of a body move along with would be rows of large
/// support, which multigrid takes badly. Instead, each freedom has a column W:
/// the amount 1 and how all else then gives way, which is solved for. After the
/// inner preconditioner's y, the columns take what is left for them, exactly,
///
///     y + W (W^T A W)^-1 W^T (x - A y),
///
/// so that the iterations stay those of the inner preconditioner. Columns are
/// kept while tangent and contact change, and improved where one would be worse
/// than none: where, with surfaces that touch since, it leaves more force than
/// the freedom moved alone.
class BorderedPreconditioner : public BiphasicPreconditioner
{
public:
   /// Borrows @a jacobian, which must have ties. Collective.
   BorderedPreconditioner(const BiphasicJacobian &jacobian, MPI_Comm comm,
                          mfem::real_t force_per_volume,
                          std::unique_ptr<BiphasicPreconditioner> inner);

   void ContactMoved() override { inner->ContactMoved(); }
   void TangentChanged() override { inner->TangentChanged(); }
   void ContactFollowed() override { inner->ContactFollowed(); }
   void Update() override;
   bool Report(const SolveAttempt &attempt) override;
   int Patience() const override;
   void Mult(const mfem::Vector &x, mfem::Vector &y) const override;

private:
   const RigidTies &Ties() const { return jacobian.Ties()->Ties(); }
   int Columns() const { return static_cast<int>(columns.size()); }
   /// Zero in the slots.
   void Hold(mfem::Vector &x) const;
   /// 1 in the slot of a freedom.
   mfem::Vector Unit(int freedom) const;
   /// Scales forces, and has zero in the slots.
   void KeepOthers(mfem::Vector &forces) const;
   /// The norm of what is kept.
   mfem::real_t NormOnOthers(mfem::Vector forces) const;
   /// Solves for all columns, from what they are.
   void SolveColumns();
   /// The same for all at once and with few iterations, of which inner learns
   /// nothing.
   void ImproveColumns();
   /// Improves columns for right sides and targets of their residuals' norms.
   using ColumnSolver = std::function<void(
      const std::vector<mfem::Vector> &forces, const mfem::Vector &targets,
      std::vector<mfem::Vector> &columns)>;
   /// Lets it improve all columns, scaled and with zero in the slots.
   void ChangeColumns(const ColumnSolver &solve);
   /// Sets W^T A W; false if a column leaves more force than its freedom alone.
   bool Project();
   /// W^T r
   mfem::Vector Restrict(const mfem::Vector &r) const;

   const BiphasicJacobian &jacobian;
   MPI_Comm comm;
   mfem::real_t force_per_volume;
   std::unique_ptr<BiphasicPreconditioner> inner;
   std::vector<mfem::Vector> columns;
   mfem::DenseMatrixInverse inverse;
   /// Whether the columns are to be solved for, and not only improved.
   bool outdated = true;
   /// Whether the columns belong to the present equations.
   bool fresh = false;
   int columns_solved = 0;
   mutable mfem::Vector right_side;
   mutable mfem::Vector residual;
};

} // namespace synovia
