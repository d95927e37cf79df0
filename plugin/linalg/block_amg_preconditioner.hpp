#pragma once

#include "synovia/linalg/biphasic_linear_solver.hpp"
#include "synovia/linalg/filtered_amg.hpp"

#include <limits>

namespace synovia
{

/// Block lower triangular: u = A^-1 r_u, p = -S^-1 (r_p + B u), with filtered
/// multigrid for A and for the Schur complement S (fixed stress).
///
/// The hierarchy for A has the contact, but with penalties as soft as the
/// bodies: these suit multigrid, and for errors longer than an element they are
/// as good as the true ones, so that iterations don't grow with the mesh. It is
/// rebuilt when much of the active set has changed since and it has served a
/// few times as long as building it takes. When the tangent changes, the
/// hierarchies stay in use until the extra iterations cost as much as new ones.
///
/// Displacements of strongly anisotropic elements, as those of fibers in a soft
/// matrix, are solved for exactly, together with the contact.
class BlockAmgPreconditioner : public BiphasicPreconditioner
{
public:
   /// Borrows @a jacobian. @a options are those of the filters' exact solves;
   /// without exact displacements they are in double precision. Collective.
   BlockAmgPreconditioner(const BiphasicJacobian &jacobian, MPI_Comm comm,
                          const DirectOptions &options,
                          const MultigridTuning &tuning);

   void ContactMoved() override;
   void TangentChanged() override;
   /// The filters serve on: a kept tangent is that of a state nearby.
   void ContactFollowed() override {}
   void Update() override;
   bool Report(const SolveAttempt &attempt) override;
   int Patience() const override { return std::numeric_limits<int>::max(); }
   void Mult(const mfem::Vector &x, mfem::Vector &y) const override;

private:
   std::vector<mfem::Vector> SoftWeights() const;
   bool IsOutdated() const;
   void BuildHierarchy();
   /// Follows the tangent with the present hierarchies, or has new ones made.
   void FollowTangent();
   /// Has better exact solves made; false if there are none.
   bool Improve();
   void UpdateDisplacement(bool gaps_changed, bool entries_changed);
   void UpdatePressure(bool jumps_changed);

   const BiphasicJacobian &jacobian;
   MPI_Comm comm;
   DirectOptions options;
   MultigridTuning tuning;
   MatrixKind kind;
   bool tangent_changed = false;
   /// Iterations that reduce the residual to a tenth, in the first solve with
   /// hierarchies of the present tangent; 0 before.
   mfem::real_t fresh_rate = 0.0;
   /// Iterations since, in excess of that rate.
   mfem::real_t extra_iterations = 0.0;
   std::unique_ptr<FilteredAmg> displacement;
   std::unique_ptr<mfem::HypreParMatrix> schur;
   std::unique_ptr<FilteredAmg> pressure;
   /// Weights that the displacement's hierarchy was built with, and the
   /// iterations that it has served.
   std::vector<mfem::Vector> soft_weights;
   int served = 0;
   bool built = false;
   bool moved = true;
   /// Whether the filters are to be factorized anew as they served badly.
   bool improved = false;
   mfem::real_t dt = -1.0;
   /// 1 for the pressures in a pair's jump, 0 for others.
   mfem::Array<int> touched;
   /// Pressures that are prescribed in the hierarchy, and in the filter only.
   mfem::Array<int> p_dofs;
   mfem::Array<int> held;
   std::vector<mfem::Vector> gap_weights;
   std::vector<mfem::Vector> jump_weights;
   mutable mfem::Vector u_free;
   mutable mfem::Vector residual;
};

} // namespace synovia
