#pragma once

#include "solvers/biphasic_linear_solver.hpp"

namespace synovia
{

/// A factorisation of the whole Jacobian, kept over steps and active sets.
///
/// A changed active set differs from the one factorised by a matrix of low
/// rank: an iteration more for each vertex that switched. The factorisation is
/// renewed when the iterations so lost amount to its cost.
class DirectPreconditioner : public BiphasicPreconditioner
{
public:
   /// Borrows @a jacobian.
   DirectPreconditioner(const BiphasicJacobian &jacobian, int renew_after);

   void ContactMoved() override {}
   void Update() override;
   bool Report(int iterations, bool converged) override;
   int Patience() const override { return renew_after; }
   void Mult(const mfem::Vector &x, mfem::Vector &y) const override;

private:
   int ChangedRows() const;

   const BiphasicJacobian &jacobian;
   int renew_after;
   int extra_iterations = 0;
   bool outdated = true;
   bool fresh = false;
   mfem::real_t dt = -1.0;
   std::vector<mfem::Vector> gap_weights;
   std::vector<mfem::Vector> jump_weights;
   std::unique_ptr<mfem::HypreParMatrix> matrix;
   std::unique_ptr<mfem::Solver> factors;
};

} // namespace synovia
