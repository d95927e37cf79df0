#pragma once

#include "synovia/fem/assembled_matrix.hpp"
#include "synovia/fem/body_element.hpp"
#include "synovia/fem/body_form.hpp"
#include "synovia/fem/corner_barrier.hpp"
#include "synovia/fem/element_damping.hpp"
#include "synovia/fem/element_permeability.hpp"
#include "synovia/fem/element_tangent.hpp"
#include "synovia/fem/evaluated_balance.hpp"
#include "synovia/fem/follower_loads.hpp"
#include "synovia/fem/gravity_loads.hpp"
#include "synovia/fem/smooth_stabilization.hpp"
#include "synovia/fem/space_patterns.hpp"
#include "synovia/fem/spring_foundation.hpp"
#include "synovia/mesh/named_mesh.hpp"

#include <array>
#include <memory>
#include <vector>

namespace synovia
{

/// Bodies in finite deformation, integrated over their undeformed shape:
///
///     momentum:  int (P_e(F) - p J F^-T) : grad w
///     mass:      int q (J - J_0) + dt int grad q . K(F) grad p
///                - dt int q J kp (pc - p) + S (p - p_0 - smooth part)
///
/// less FollowerLoads and GravityLoads, with F = I + grad u, the pressure p of
/// the fluid in space, and J_0 what the stage begins with: fluid is conserved
/// to round-off, whatever the step. K is an ElementPermeability. Elements of
/// order 1 have a CornerBarrier.
/// Large because BodyForm is.
class TotalLagrangianForm : public BodyForm
{
public:
   /// Borrows all arguments. Throws Error where a material is none for finite
   /// deformation. Tangents are integrated at @a tangent_points: those of
   /// straight sides take a third of the time where sides are curved, whose
   /// part is that at rest then, and Newton's method still solves for the exact
   /// residual. Collective.
   TotalLagrangianForm(const NamedMesh &mesh, BiphasicSpaces &spaces,
                       const MaterialTable &materials,
                       const std::vector<SpringFoundation> &springs,
                       const FollowerLoads &loads,
                       ElementPoints tangent_points = ElementPoints::as_meshed,
                       const GravityLoads *gravity = nullptr);

   int ConservedSize() const override { return element.AllPoints(); }
   void GetConserved(const mfem::Vector &u,
                     mfem::Vector &conserved) const override;
   void StartStage(const BodyStage &stage, const mfem::Vector &pressure_rate,
                   mfem::real_t rate_dt) override;
   void Mult(const BodyStage &stage, mfem::Vector &momentum,
             mfem::Vector &mass) const override;
   void MultFromStart(const BodyStage &stage, mfem::Vector &momentum,
                      mfem::Vector &mass) const override;
   void GetGrowth(const BodyStage &stage, mfem::Vector &growth) const override;
   void AddLoads(const BodyStage &stage, mfem::Vector &momentum) const override;
   mfem::real_t Inflow(const BodyStage &stage) const override;
   std::optional<mfem::real_t> Supply(const BodyStage &stage) const override;
   void AddMagnitudes(mfem::real_t dt, const mfem::Vector &u,
                      const mfem::Vector &p, mfem::Vector &momentum,
                      mfem::Vector &mass) const override;
   std::string Validate(const BodyStage &stage) const override;
   bool IsLinear() const override { return false; }
   bool Damp(const BodyStage &stage, const mfem::Vector &direction) override;
   void EaseDamping() override { damping.Lower(); }
   void AddDampingForces(const mfem::Vector &displacement,
                         mfem::Vector &forces) const override;
   bool Linearize(const BodyStage &stage) override;
   const VolumeMatrices &Tangent() const override { return matrices; }

private:
   /// Sets u and p from true dofs.
   void ToLocal(const BodyStage &stage) const;
   /// The local dofs of a displacement.
   mfem::Vector ToLocal(const mfem::Vector &displacement) const;
   /// What loads are asked for at, after ToLocal().
   FollowerLoads::State ToLoads(const BodyStage &stage) const;
   /// Evaluates at a stage unless it was there last.
   void Remember(const BodyStage &stage, EvaluatedBalance &evaluated) const;
   /// The same without looking.
   void Evaluate(const BodyStage &stage, EvaluatedBalance &evaluated) const;
   /// Sets the balance where a stage starts from the one where the stage before
   /// it ended, if that is the same state.
   void CarryOver(const BodyStage &stage);
   bool HasLoads() const { return loads.Any() || gravity; }
   /// Adds the loads and the volume / time that they let in, local dofs, after
   /// ToLocal().
   void AddLocalLoads(const BodyStage &stage, mfem::Vector &forces,
                      mfem::Vector &inflow) const;
   /// Adds an element's part to the local sums; not finite where its state is
   /// impossible. Sets the @a volume_ratios at its points.
   void AddElement(const BodyStage &stage, mfem::Vector &volume_ratios) const;
   /// The effective stress at a point of the element, after Evaluate() where
   /// the material has a mean dilatation; false where the law has no value.
   bool GetStress(const Material &material, int point, const Tensor3<> &F,
                  Tensor3<> &stress) const;
   /// Whether an element, by its number on this rank, is part of a rigid body.
   bool IsRigid(int number) const;
   void AddStabilization(const BodyStage &stage, mfem::Vector &mass) const;
   void AddSprings();
   /// Sets what terms cancel where nothing is deformed.
   void MeasureRest();
   std::array<AssembledMatrix *, 4> Matrices()
   {
      return {&stiffness, &growth_transpose, &divergence, &darcy};
   }
   /// Makes what curved sides add to the tangent at rest a constant part of it.
   void CorrectStraightTangent();
   /// Sets the tangent to an element's.
   void LinearizeElement(int number, mfem::real_t dt);
   /// The same with these points; false where a law has no value.
   bool LinearizeElement(BodyElement &points, int number, mfem::real_t dt);
   void AddTangent(int element);
   /// What is impossible at a point of the element, which has this number on
   /// its rank, and at its corners; without reduction.
   std::string ValidatePoint(int number, int point) const;
   std::string ValidateCorners(int number) const;
   /// Where a point is whose undeformed coordinates are @a x, and its det F.
   std::string Place(int number, const mfem::Vector &x, mfem::real_t J) const;

   const NamedMesh &mesh;
   BiphasicSpaces &spaces;
   const MaterialTable &materials;
   const std::vector<SpringFoundation> &springs;
   const FollowerLoads &loads;
   /// Null if there is none.
   const GravityLoads *gravity;
   SpacePatterns patterns;
   VolumeMatrices matrices;
   mutable EvaluatedBalance balance;
   /// Where stages start.
   mutable EvaluatedBalance start_balance;
   std::unique_ptr<SmoothStabilization> smooth_stabilization;
   mfem::Vector relief;
   /// Magnitudes of what cancels in a body at rest, true dofs.
   mfem::Vector rest_momentum;
   mfem::Vector rest_mass;
   AssembledMatrix stiffness;
   /// The derivative of the growth of volume, transposed.
   AssembledMatrix growth_transpose;
   /// With the change of flow.
   AssembledMatrix divergence;
   AssembledMatrix darcy;
   mutable BodyElement element;
   ElementDamping damping;
   /// For tangents, where it has fewer points; else null.
   std::unique_ptr<BodyElement> straight_element;
   /// Null where elements have no need of one.
   std::unique_ptr<CornerBarrier> barrier;
   ElementTangent tangent;
   mutable MeanDilatation mean_dilatation;
   mutable ElementPermeability permeability;
   /// What Evaluate() sums: local dofs.
   struct LocalSums
   {
      mfem::Vector momentum;
      mfem::Vector growth;
      mfem::Vector flow;
   };
   mutable LocalSums local;
   /// Local dofs.
   mutable mfem::Vector u;
   mutable mfem::Vector u0;
   mutable mfem::Vector p;
};

} // namespace synovia
