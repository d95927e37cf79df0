#pragma once

#include "synovia/linalg/biphasic_linear_solver.hpp"
#include "synovia/linalg/low_rank_update.hpp"

#include <array>
#include <map>

namespace synovia
{

/// A factorization of the whole Jacobian, the freedoms of rigid bodies
/// included, kept over steps and active sets.
///
/// A changed active set differs from the one factorized by a matrix of low
/// rank: each vertex that touches or leaves, each jump that is closed or open,
/// each pressure that drains or is sealed makes one column. A column costs one
/// solve, less in a batch, when it first occurs, and little after that. Other
/// changes, such as a slightly different time step, cost iterations. The
/// factorization is renewed when all these costs amount to its own.
class DirectPreconditioner : public BiphasicPreconditioner
{
public:
   /// Borrows @a jacobian. Collective.
   DirectPreconditioner(const BiphasicJacobian &jacobian, MPI_Comm comm,
                        int renew_after, const DirectOptions &options,
                        const FactorizationTuning &tuning);

   /// How many columns, vectors of all unknowns, may accumulate before the
   /// factorization is renewed.
   static mfem::real_t MostColumns(int renew_after,
                                   const FactorizationTuning &tuning);

   void ContactMoved() override;
   /// Older factors serve as long as their iterations cost less than new ones.
   void TangentChanged() override;
   void ContactFollowed() override { TangentChanged(); }
   void Update() override;
   bool Report(const SolveAttempt &attempt) override;
   int Patience() const override;
   void Mult(const mfem::Vector &x, mfem::Vector &y) const override;

private:
   enum Kind
   {
      gap_row,
      jump_row,
      held_pressure
   };
   /// Which column: kind, pair, global row of the operator or global true dof
   /// of the pressure.
   using Key = std::array<HYPRE_BigInt, 3>;
   /// What differs from the matrix factorized; the same list on all ranks.
   struct Change
   {
      Key key;
      mfem::real_t weight;
   };
   using Column = LowRankUpdate::Column;

   bool IsLikeFactorized() const;
   std::vector<Change> FindChanges() const;
   /// Precision and compression of the first factorization.
   void ChooseAccuracy();
   /// Has factors made that approximate the matrix better; false if there are
   /// none.
   bool RefineFactors();
   void Factorize();
   /// Updates the factors by columns; false if that would cost more than a
   /// factorization.
   bool Follow(const std::vector<Change> &changes);
   /// Changes that have no column yet, or an outdated one. Collective.
   std::vector<Key> FindMissing(const std::vector<Change> &changes);
   /// Makes the columns, solved for in batches.
   void AddColumns(const std::vector<Key> &keys);
   /// Its z is left empty.
   Column ColumnOf(const Key &key);
   /// Global rows of a contact operator x local true dofs.
   const mfem::SparseMatrix &Rows(const mfem::HypreParMatrix &matrix);
   /// The same of a matrix for displacements, with the freedoms of rigid
   /// bodies.
   const mfem::SparseMatrix &RowsOnFreedoms(const mfem::HypreParMatrix &matrix);
   /// Adds a row of a contact operator on free dofs to @a part.
   void AddDisplacements(const mfem::HypreParMatrix &matrix, int row,
                         SparsePart &part);
   void AddPressures(const mfem::HypreParMatrix &matrix, int row,
                     SparsePart &part);

   const BiphasicJacobian &jacobian;
   MPI_Comm comm;
   int renew_after;
   DirectOptions options;
   FactorizationTuning tuning;
   /// Of the last solve with new factors: iterations, and decades by which the
   /// residual fell.
   int fresh_iterations = 1;
   mfem::real_t fresh_decades = 1.0;
   /// Iterations that old factors took beyond what new ones would have.
   mfem::real_t extra_solves = 0.0;
   bool outdated = true;
   bool fresh = false;
   /// Whether the contact operators differ from those factorized.
   bool moved = false;
   mfem::real_t dt = -1.0;
   std::vector<mfem::Vector> gap_weights;
   std::vector<mfem::Vector> jump_weights;
   mfem::Array<int> p_dofs;
   mfem::Vector holding;
   std::unique_ptr<mfem::Solver> factors;
   std::map<const mfem::HypreParMatrix *, std::unique_ptr<mfem::SparseMatrix>>
      tables;
   /// Of the present tangent, once it was needed.
   std::unique_ptr<TieMap> tie_map;
   std::map<Key, Column> columns;
   LowRankUpdate update;
   mutable mfem::Vector right_side;
};

} // namespace synovia
