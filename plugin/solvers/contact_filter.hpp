#pragma once

#include "solvers/biphasic_jacobian.hpp"

namespace synovia
{

/// Approximate inverse of K + G^T W G that never rebuilds its hierarchy.
///
/// One V-cycle of BoomerAMG, set up once on K alone, stands between two exact
/// solves on the dofs that contact touches, where the penalty is: filter,
/// V-cycle, filter, with the residual renewed in between. So neither the size
/// of the penalty nor a change of the active set spoils the multigrid. The idea
/// is AMG with filtering (Petrides et al. 2025); there the hierarchy is that of
/// the whole matrix and the order is AMG, filter, AMG.
class FilteredAmg : public mfem::Solver
{
public:
   /// Borrows @a jacobian, whose displacement block it approximates. Sets up
   /// the multigrid. Collective.
   FilteredAmg(const BiphasicJacobian &jacobian,
               mfem::ParFiniteElementSpace &displacement);

   /// Takes the contact dofs anew, after a search. Collective.
   void UpdateSubspace();
   /// Takes the contact weights anew, after a change of the active set.
   /// Collective.
   void UpdateWeights();

   void SetOperator(const mfem::Operator &) override;
   void Mult(const mfem::Vector &x, mfem::Vector &y) const override;

private:
   void Filter(const mfem::Vector &residual, mfem::Vector &correction) const;

   const BiphasicJacobian &jacobian;
   std::unique_ptr<mfem::HypreParMatrix> stiffness;
   mfem::HypreBoomerAMG amg;
   mfem::Array<int> contact_dofs;
   bool has_contact = false;
   std::unique_ptr<mfem::HypreParMatrix> restriction;
   std::unique_ptr<mfem::HypreParMatrix> stiffness_in_contact;
   std::vector<std::unique_ptr<mfem::HypreParMatrix>> gaps_in_contact;
   std::unique_ptr<mfem::Solver> contact_solver;
   mutable mfem::Vector residual;
   mutable mfem::Vector correction;
   mutable mfem::Vector small_residual;
   mutable mfem::Vector small_correction;
};

} // namespace synovia
