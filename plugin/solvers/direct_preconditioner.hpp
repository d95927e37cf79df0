#pragma once

#include "solvers/biphasic_linear_solver.hpp"
#include "solvers/low_rank_update.hpp"

#include <array>
#include <map>

namespace synovia
{

/// A factorisation of the whole Jacobian, kept over steps and active sets.
///
/// A changed active set differs from the one factorised by a matrix of low
/// rank: a vertex that touches or leaves by rank one, a pressure that drains or
/// is sealed by rank two. Each such change costs one solve (or two) when it
/// first occurs, and nothing in the systems after that. What else changes, such
/// as a slightly different time step, costs iterations. The factorisation is
/// renewed when all that amounts to its cost.
class DirectPreconditioner : public BiphasicPreconditioner
{
public:
   /// Borrows @a jacobian. Collective.
   DirectPreconditioner(const BiphasicJacobian &jacobian, MPI_Comm comm,
                        int renew_after);

   void ContactMoved() override {}
   void Update() override;
   bool Report(int iterations, bool converged) override;
   int Patience() const override { return renew_after; }
   void Mult(const mfem::Vector &x, mfem::Vector &y) const override;

private:
   enum Kind
   {
      gap_row,
      jump_row,
      /// Pressures that drain now but not when the matrix was factorised, and
      /// the other way round.
      drained,
      sealed
   };
   /// What differs from the matrix factorised; the same list on all ranks.
   struct Change
   {
      int kind;
      int pair;
      /// Global row of the operator, or global true dof of the pressure.
      HYPRE_BigInt row;
      /// By how much the weight grew; 0 for pressures.
      mfem::real_t weight;
   };
   /// Kind, pair, row, and 1 for the second column of a pressure.
   using Key = std::array<HYPRE_BigInt, 4>;

   bool IsLikeFactorised() const;
   std::vector<Change> FindChanges() const;
   void Factorise();
   bool Follow(const std::vector<Change> &changes);
   mfem::Vector RowOf(const Change &change) const;
   /// Unit vector of a global pressure dof.
   mfem::Vector UnitPressure(HYPRE_BigInt dof) const;
   mfem::real_t Entry(const mfem::Vector &x, HYPRE_BigInt dof) const;

   const BiphasicJacobian &jacobian;
   MPI_Comm comm;
   int renew_after;
   int extra_solves = 0;
   bool outdated = true;
   bool fresh = false;
   mfem::real_t dt = -1.0;
   std::vector<mfem::Vector> gap_weights;
   std::vector<mfem::Vector> jump_weights;
   mfem::Array<int> p_dofs;
   std::unique_ptr<mfem::HypreParMatrix> matrix;
   std::unique_ptr<mfem::Solver> factors;
   std::map<Key, LowRankUpdate::Column> columns;
   LowRankUpdate update;
};

} // namespace synovia
