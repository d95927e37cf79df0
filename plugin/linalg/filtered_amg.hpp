#pragma once

#include "synovia/linalg/penalized_solver.hpp"

#include <memory>
#include <optional>
#include <vector>

namespace synovia
{

/// Approximate inverse of A + sum F^T W R that seldom rebuilds its hierarchy.
///
/// A, a sum of matrices, suits multigrid; F the gap or jump operator of a
/// contact pair, W its weights, the penalties, and R is F, or how gaps change
/// where that is another matrix. Before one V-cycle of BoomerAMG, whose
/// hierarchy is that of A or of a matrix near to the whole that suits multigrid
/// as well, comes an exact solve on the dofs of the rows that have a weight,
/// the filter, and after it another one if wanted, with the residual updated in
/// between. So neither the size of the penalty nor a change of the active set
/// spoils the multigrid. Dofs that contact holds, such as pressures that drain
/// where there is none, are left to the exact solves in the same way, and so
/// are those of bodies that multigrid smooths slowly. The idea is AMG with
/// filtering (Petrides et al. 2025); there the hierarchy is that of the whole
/// matrix and the order is AMG, filter, AMG.
class FilteredAmg : public mfem::Solver
{
public:
   using Matrices = std::vector<const mfem::HypreParMatrix *>;
   /// F and R of a pair, rows x true dofs.
   struct Factor
   {
      const mfem::HypreParMatrix *forces;
      const mfem::HypreParMatrix *changes;
   };
   using Factors = std::vector<Factor>;
   /// When the exact solves are made: before the V-cycle, or before and after
   /// it. What a V-cycle leaves to the second one, the first one of the next
   /// iteration finds as well.
   enum class Filter
   {
      before,
      around
   };

   /// Borrows @a terms, whose sum is A, at least one; their rows and columns of
   /// the @a prescribed true dofs, ascending, don't count: those have unit rows
   /// in the inverse.
   /// Solves exactly for the @a exact dofs, too, of which multigrid then knows
   /// nothing, and for @a overlap layers of dofs around these and those of the
   /// rows that have a weight, with a direct solver that has @a options, for
   /// matrices of this @a kind where no R is another than F. A factorization
   /// serves for changed weights until they have made @a most_columns.
   /// Collective.
   FilteredAmg(Matrices terms, const mfem::Array<int> &prescribed,
               const mfem::Array<int> &exact, int overlap, Filter filter,
               MatrixKind kind, const DirectOptions &options, int most_columns);

   /// Takes @a amg, with its options but without an operator, and builds its
   /// hierarchy on @a alike, which has unit rows and columns for the prescribed
   /// dofs. Must come first. SetWeights() must follow. Collective. A call of
   /// ClearHierarchy() before @a alike is made saves memory.
   void SetHierarchy(std::unique_ptr<mfem::HypreParMatrix> alike,
                     std::unique_ptr<mfem::HypreBoomerAMG> amg);
   void ClearHierarchy();
   /// Borrows the contact operators until the next call. Their columns at
   /// prescribed dofs don't count. SetWeights() must follow.
   void SetFactors(const Factors &factors);
   /// Replaces A's terms and the factors, borrowed, by others that differ
   /// little: hierarchy and factorization stay in use until the dofs to solve
   /// for exactly change.
   void Replace(Matrices terms, const Factors &factors);
   /// Sets dofs, ascending and among those that Touched() gives for the
   /// factors, that are treated as if they were prescribed, although they are
   /// free in the hierarchy. SetWeights() must follow.
   void SetHeld(const mfem::Array<int> &dofs) { held = dofs; }
   /// Sets the weights, not negative, of each factor, and counts factorizations
   /// and columns. @a in_hierarchy are the weights with which factors are part
   /// of the hierarchy's matrix, empty if they are not: the exact solves
   /// correct it there. Throws FactorizationError. Collective.
   void SetWeights(const std::vector<mfem::Vector> &weights,
                   const std::vector<mfem::Vector> &in_hierarchy,
                   WorkCounts &work);
   /// As PenalizedSolver::Improve().
   bool Improve() { return in_contact.Improve(); }

   /// 1 for the dofs, @a size on this rank, in which an F has entries, 0
   /// elsewhere. Collective.
   static mfem::Array<int> Touched(int size, const Factors &factors);

   void SetOperator(const mfem::Operator &) override;
   void Mult(const mfem::Vector &x, mfem::Vector &y) const override;

private:
   /// 1 for the dofs of the factors' rows that have a weight, now or in the
   /// hierarchy, for those held and for the exact ones.
   mfem::Array<int> Needed(const std::vector<mfem::Vector> &weights,
                           const std::vector<mfem::Vector> &in_hierarchy) const;
   /// Adds to the selected dofs; true if the selection changed on any rank.
   /// Dofs that aren't needed any more stay selected: they may come back.
   bool Select(const mfem::Array<int> &needed);
   /// Restricts matrix and factors to the selected dofs and their neighbors.
   void Restrict();
   /// The columns of A that @a injection, dofs x some of them, picks.
   std::unique_ptr<mfem::HypreParMatrix>
   Columns(const mfem::HypreParMatrix &injection) const;
   /// Of the held dofs, their places among the contact dofs.
   mfem::Array<int> HeldInContact() const;
   /// A V-cycle.
   void Cycle(const mfem::Vector &x, mfem::Vector &y) const;
   /// Sets the residual that the first exact solve leaves of @a x. At exact
   /// dofs it is none; elsewhere in contact factors that are symmetric, or of
   /// an older tangent, leave some.
   void RemoveContact(const mfem::Vector &x) const;
   /// Adds to the contact's solution the exact one for the residual that a
   /// V-cycle's @a y makes there.
   void CorrectContact(const mfem::Vector &y) const;

   Matrices terms;
   mfem::Array<int> prescribed;
   mfem::Array<int> exact;
   bool has_exact;
   int overlap;
   Filter filter;
   mfem::Array<int> held;
   std::unique_ptr<mfem::HypreParMatrix> alike;
   std::unique_ptr<mfem::HypreBoomerAMG> amg;
   double bytes_of_cycle = 0.0;
   Factors factors;
   /// 1 for the dofs to solve for exactly, but for their neighbors; unset after
   /// a change of factors or hierarchy.
   std::optional<mfem::Array<int>> selected;
   mfem::Array<int> contact_dofs;
   bool has_contact = false;
   /// Picks what the V-cycle moves: neither prescribed nor exact dofs.
   std::unique_ptr<mfem::HypreParMatrix> smoothed;
   /// A's columns of the contact dofs, in rows that the V-cycle moves: the
   /// contact's rows as well, as A is symmetric, or nearly so.
   std::unique_ptr<mfem::HypreParMatrix> smoothed_columns;
   /// For all on the contact dofs alone.
   PenalizedSolver in_contact;
   mutable mfem::Vector residual;
   mutable mfem::Vector first;
   mutable mfem::Vector small_residual;
   mutable mfem::Vector small_correction;
};

} // namespace synovia
