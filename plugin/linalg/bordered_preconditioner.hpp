#pragma once

#include "synovia/linalg/biphasic_linear_solver.hpp"

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
/// kept while tangent and contact change, and solved for anew once the
/// iterations that this costs are as many as that takes.
class BorderedPreconditioner : public BiphasicPreconditioner
{
public:
   /// Borrows @a jacobian, which must have ties. Collective.
   BorderedPreconditioner(const BiphasicJacobian &jacobian, MPI_Comm comm,
                          mfem::real_t force_per_volume,
                          std::unique_ptr<BiphasicPreconditioner> inner);

   void ContactMoved() override { inner->ContactMoved(); }
   void TangentChanged() override { inner->TangentChanged(); }
   void Update() override;
   bool Report(const SolveAttempt &attempt) override;
   int Patience() const override;
   void Mult(const mfem::Vector &x, mfem::Vector &y) const override;

private:
   const RigidTies &Ties() const { return jacobian.Ties()->Ties(); }
   int Columns() const { return static_cast<int>(columns.size()); }
   /// Zero in the slots.
   void Hold(mfem::Vector &x) const;
   void SolveColumns();
   /// For scaled @a forces, from the column as it is; returns the iterations.
   int SolveColumn(const mfem::Vector &forces, int most_iterations,
                   mfem::FGMRESSolver &solver, int column);
   /// Sets W^T A W.
   void Project();
   /// W^T r
   mfem::Vector Restrict(const mfem::Vector &r) const;

   const BiphasicJacobian &jacobian;
   MPI_Comm comm;
   mfem::real_t force_per_volume;
   std::unique_ptr<BiphasicPreconditioner> inner;
   std::vector<mfem::Vector> columns;
   /// Of a freedom whose surroundings are held (force / length).
   mfem::Vector held_stiffness;
   mfem::DenseMatrixInverse inverse;
   /// Iterations spent on the columns; iterations of the first solve with them
   /// for a tenth of the residual; and iterations since beyond that rate.
   int column_iterations = 0;
   mfem::real_t fresh_rate = 0.0;
   mfem::real_t extra_iterations = 0.0;
   bool outdated = true;
   /// Whether the columns belong to the present equations.
   bool fresh = false;
   int columns_solved = 0;
   mutable mfem::Vector right_side;
   mutable mfem::Vector residual;
};

} // namespace synovia
