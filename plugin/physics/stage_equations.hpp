#pragma once

#include "synovia/contact/tied_interface.hpp"
#include "synovia/fem/body_form.hpp"
#include "synovia/fem/boundary_conditions.hpp"
#include "synovia/fem/tie_tangent.hpp"
#include "synovia/linalg/biphasic_jacobian.hpp"
#include "synovia/physics/contact_drainage.hpp"

#include <memory>
#include <optional>
#include <vector>

namespace synovia
{

/// One implicit stage with the loads that do not follow the deformation, as
/// BoundaryConditions::GetLoads() has them.
struct ImplicitStage : BodyStage
{
   mfem::Vector momentum_load;
   mfem::Vector mass_load;
   /// Of rigid bodies, whose tied dofs u has.
   RigidPoses poses;
   /// Whether the bodies' part is that of BodyForm::MultFromStart().
   bool from_start = false;
   /// Whether it begins where a rate leads.
   bool is_expected = true;
   /// Where bodies may begin; of nonlinear bodies only.
   struct State
   {
      mfem::Vector u;
      mfem::Vector p;
      RigidPoses poses;
   };
   /// All but supports rests where the stage began.
   State rest;
   /// The same, but bodies that rigid ones carry have moved along, if these
   /// turn.
   std::optional<State> carried;

   /// Begins there rather than where a rate leads: along with what carries the
   /// bodies where there is such a state, else at rest, with a linear step.
   void BeginAnew()
   {
      const State &begin = carried ? *carried : rest;
      u = begin.u;
      p = begin.p;
      // Contact and loads are evaluated on the host.
      u.HostReadWrite();
      p.HostReadWrite();
      poses = begin.poses;
      from_start = !carried;
      is_expected = false;
   }
};

/// How forces and fluid balance in a stage.
struct StageBalance
{
   /// Forces that hold the bodies (true dofs): at prescribed dofs the force
   /// that the support exerts on the body, elsewhere the remaining error.
   mfem::Vector support;
   /// Forces of loads, contact and ties on the bodies (true dofs).
   mfem::Vector loads;
   /// Growth of the bodies' volume (volume / time).
   mfem::real_t growth = 0.0;
   /// Fluid that leaves through drained and prescribed boundaries (volume /
   /// time).
   mfem::real_t outflow = 0.0;
   /// What vessels let in (volume / time); none without vessels.
   std::optional<mfem::real_t> supply;
   /// What is missing: growth + outflow - supply (volume / time).
   mfem::real_t error = 0.0;
};

/// The equations of an implicit stage: balance of momentum and mass of all
/// bodies with loads, supports, ties and contact, with the contact's active
/// sets as they are; their residual and its derivative. What is said of the
/// contact holds for the ties as well.
///
/// The residual is r(u, p) = -(momentum), (mass) for true dofs of displacement
/// and pressure, with zeros at prescribed and drained dofs, and Jacobian() is
/// -dr/d(u, p). Where surfaces are driven, displacements and forces are those
/// of RigidSurfaces; where they are tied to rigid bodies, r has what is missing
/// for balance of the bodies in the slots of RigidTies. Momentum is in force,
/// mass in volume of fluid in the stage. All members are collective.
///
/// Large because each part of a stage is evaluated and linearized on its own.
class StageEquations
{
public:
   /// Borrows all but @a bodies; @a conditions must be complete. Lets the
   /// surfaces of @a interfaces look for each other. Throws Error where they
   /// find nothing.
   StageEquations(BiphasicSpaces &spaces, const BoundaryConditions &conditions,
                  const std::vector<ContactPair *> &pairs,
                  const std::vector<TiedInterface *> &interfaces,
                  std::unique_ptr<BodyForm> bodies);

   BodyForm &Bodies() { return *bodies; }
   const BodyForm &Bodies() const { return *bodies; }
   const RigidSurfaces &Rigid() const { return rigid; }
   RigidTies &Ties() { return ties; }
   const RigidTies &Ties() const { return ties; }
   const synovia::Ligaments &Ligaments() const { return ligaments; }
   const synovia::Joints &Joints() const { return joints; }
   /// Whether each ligament resists, at the last LinearizeTies().
   const std::vector<bool> &ResistingLigaments() const { return resisting; }
   /// At the last Linearize...() and Set...() of each of its parts.
   const BiphasicJacobian &Jacobian() const { return *jacobian; }

   void SetTimeStep(mfem::real_t dt);
   /// Lets pairs search for a stage that ends near @a stage; says whether what
   /// contact and ties add to the Jacobian is another.
   bool SearchContact(const BodyStage &stage);
   /// Takes gaps, jumps, tractions and fluxes at the end of @a stage.
   void EvaluateContact(const BodyStage &stage);
   /// Drains what the active sets leave open, in @a stage and in the equations,
   /// and evaluates the contact there.
   void UpdateDrainedDofs(BodyStage &stage);
   /// Prescribed and drained true dofs of the pressure, ascending.
   void SetDrainedDofs(const mfem::Array<int> &dofs);
   const mfem::Array<int> &DrainedDofs() const;

   /// What is missing for balance at each true dof: what supports and drained
   /// boundaries have to give, else an error. Of the contact as it was
   /// evaluated last.
   void ComputeImbalance(const ImplicitStage &stage, mfem::Vector &momentum,
                         mfem::Vector &mass) const;
   /// The part of it that has nothing of contact.
   void ComputeBodyImbalance(const ImplicitStage &stage, mfem::Vector &momentum,
                             mfem::Vector &mass) const;
   /// Adds the part that is the contact's, as it was evaluated last.
   void AddContactImbalance(const ImplicitStage &stage, mfem::Vector &momentum,
                            mfem::Vector &mass) const;
   /// Makes the residual of what is missing for balance.
   void MakeResidual(const ImplicitStage &stage,
                     mfem::BlockVector &imbalance) const;
   /// Of the contact as it was evaluated last.
   void ComputeResidual(const ImplicitStage &stage,
                        mfem::BlockVector &residual) const;
   StageBalance Balance(const ImplicitStage &stage) const;

   /// Brings the Jacobian to the state of @a stage; says whether it changed.
   bool LinearizeBodies(const BodyStage &stage);
   /// The same for the contact, which must have been evaluated there.
   bool LinearizeContact(const BodyStage &stage);
   /// Keeps the derivatives of the last LinearizeContact(), with the maps of
   /// nodal forces and flows as they were evaluated last.
   void KeepContactTangent() { UpdateFactors(); }
   /// The same for what is tied to rigid bodies, with the forces of the contact
   /// as it was evaluated last.
   void LinearizeTies(const ImplicitStage &stage);

   /// Adds a share of a step, a solution of the linearized equations, to
   /// displacement, pressure, and poses of rigid bodies.
   void Add(mfem::real_t share, const mfem::BlockVector &step,
            ImplicitStage &stage) const;
   /// The displacement of all nodes in a step, to first order.
   mfem::Vector DisplacementIn(const mfem::BlockVector &step) const;

private:
   /// Adds forces on bodies and the flow between them (volume / time).
   void AddContactForces(mfem::Vector &forces, mfem::Vector &exchange) const;
   void UpdateFactors();
   /// Scales what drives joints by how tied bodies resist.
   void ScaleDrives();

   MPI_Comm comm;
   const BoundaryConditions &conditions;
   const std::vector<ContactPair *> &pairs;
   const std::vector<TiedInterface *> &interfaces;
   std::unique_ptr<BodyForm> bodies;
   RigidTies ties;
   synovia::Ligaments ligaments;
   synovia::Joints joints;
   RigidSurfaces rigid;
   TieTangent tie_tangent;
   std::vector<bool> resisting;
   ContactDrainage drainage;
   /// What pairs and interfaces add to the Jacobian, in their order.
   ContactTerms contact;
   bool has_factors = false;
   std::unique_ptr<BiphasicJacobian> jacobian;
};

} // namespace synovia
