#pragma once

#include "synovia/linalg/direct_solver.hpp"
#include "synovia/linalg/low_rank_update.hpp"
#include "synovia/linalg/work_counts.hpp"

#include <array>
#include <map>
#include <memory>
#include <vector>

namespace synovia
{

/// Exact solves with A + sum F^T W R for diagonal weights W that change.
///
/// The matrix is factorized with some weights. As long as few rows of F have
/// others, each of these makes a column of a low-rank update, which is solved
/// for once: a fraction of a factorization.
class PenalizedSolver : public mfem::Solver
{
public:
   /// F and R, rows x dofs of A.
   struct Factor
   {
      std::unique_ptr<mfem::HypreParMatrix> forces;
      /// Null where it is F.
      std::unique_ptr<mfem::HypreParMatrix> changes;

      const mfem::HypreParMatrix &Changes() const
      {
         return changes ? *changes : *forces;
      }
   };

   /// A is of this @a kind; the sum is too, where no R is another than F.
   /// @a most_columns may be made of a factorization.
   PenalizedSolver(MatrixKind kind, const DirectOptions &options,
                   int most_columns);

   /// SetHeld() and SetWeights() must follow. Collective.
   void SetMatrices(std::unique_ptr<mfem::HypreParMatrix> matrix,
                    std::vector<Factor> factors);
   /// Sets dofs, ascending, that count as prescribed: they are zero in
   /// solutions. SetWeights() must follow. Collective.
   void SetHeld(const mfem::Array<int> &dofs);
   /// Sets the weights, not negative, of each factor, and counts factorizations
   /// and columns. Throws FactorizationError. Collective.
   void SetWeights(const std::vector<mfem::Vector> &weights, WorkCounts &work);
   /// Gives up the update for a factorization or, without an update, factors of
   /// single precision for good; false if there is neither. If true,
   /// SetWeights() must follow.
   bool Improve();

   /// y += scale sum F^T W R x
   void AddPenalties(mfem::real_t scale, const mfem::Vector &x,
                     mfem::Vector &y) const;

   void SetOperator(const mfem::Operator &) override;
   void Mult(const mfem::Vector &x, mfem::Vector &y) const override;

private:
   /// Factor and global row of it.
   using Key = std::array<HYPRE_BigInt, 2>;
   struct Change
   {
      Key key;
      mfem::real_t weight;
   };

   bool IsSymmetric() const;
   void Factorize();
   /// Gives up factors of single precision; false if they aren't.
   bool RefineFactors();
   /// This rank's rows whose weights aren't the factorized ones.
   std::vector<Change> FindChanges() const;
   /// Updates the factors; false if that would take too many columns.
   bool Follow(WorkCounts &work);
   /// Makes the columns of @a keys, ascending. Collective.
   void AddColumns(const std::vector<Key> &keys);
   /// Adds rows of one factor's F or R to the columns' @a member. Collective.
   void PickRows(const mfem::HypreParMatrix &factor,
                 const std::vector<Key> &keys,
                 SparsePart LowRankUpdate::Column::*member);

   MatrixKind kind;
   DirectOptions options;
   int most_columns;
   std::unique_ptr<mfem::HypreParMatrix> matrix;
   std::vector<Factor> factors;
   mfem::Array<int> held;
   std::vector<mfem::Vector> weights;
   std::unique_ptr<mfem::Solver> factorization;
   /// What it is of.
   std::vector<mfem::Vector> factorized;
   bool outdated = true;
   bool symmetric = true;
   /// Those made since, whether or not their rows have other weights now.
   std::map<Key, LowRankUpdate::Column> columns;
   /// Null while nothing has changed.
   std::unique_ptr<LowRankUpdate> update;
   mutable mfem::Vector right_side;
};

} // namespace synovia
