#pragma once

#include "synovia/fem/biphasic_spaces.hpp"
#include "synovia/fem/follower_loads.hpp"
#include "synovia/fem/joint.hpp"
#include "synovia/fem/ligament.hpp"
#include "synovia/fem/rigid_body.hpp"
#include "synovia/fem/rigid_surfaces.hpp"
#include "synovia/fem/spring_foundation.hpp"
#include "synovia/general/load_curve.hpp"
#include "synovia/general/state_archive.hpp"
#include "synovia/materials/deformation.hpp"

#include <memory>
#include <vector>

namespace synovia
{

/// Prescribed values and loads of a biphasic problem, by attribute lists.
///
/// Coefficients are borrowed and evaluated at the time of the stage. Where two
/// prescriptions meet on a dof, the later one holds. All members that add
/// something are collective.
///
/// Large because each kind of condition has a member.
class BoundaryConditions
{
public:
   /// Borrows @a spaces. In finite @a deformation loads along the normal follow
   /// it, and areas are the current ones; other loads are dead: as given, and
   /// per undeformed area.
   explicit BoundaryConditions(
      BiphasicSpaces &spaces,
      Deformation deformation = Deformation::infinitesimal);

   /// One component (0, 1, 2) of the displacement (length).
   void PrescribeDisplacement(const mfem::Array<int> &boundary, int component,
                              const LoadCurve &value);
   /// How far the displacement is from what it is at the time @a since, when
   /// SetOrigins() is called; from 0 until then.
   void PrescribeIncrement(const mfem::Array<int> &boundary, int component,
                           const LoadCurve &value, mfem::real_t since);
   /// All components, varying in space and time.
   void PrescribeDisplacement(const mfem::Array<int> &boundary,
                              mfem::VectorCoefficient &value);

   /// Fluid pressure, positive in compression (stress).
   void PrescribePressure(const mfem::Array<int> &boundary,
                          const LoadCurve &value);
   void PrescribePressure(const mfem::Array<int> &boundary,
                          mfem::Coefficient &value);

   /// Keeps these pressures (true dofs, ascending) at zero, whatever else is
   /// prescribed there: those that no fluid has.
   void HoldDryPressures(const mfem::Array<int> &dofs);

   /// Total traction sigma_T n = direction x value (stress).
   void AddTraction(const mfem::Array<int> &boundary,
                    const mfem::Vector &direction, const LoadCurve &value);
   void AddTraction(const mfem::Array<int> &boundary,
                    mfem::VectorCoefficient &value);
   /// Total traction value x n, n outward: tension is positive (stress). It
   /// follows finite deformation.
   void AddNormalTraction(const mfem::Array<int> &boundary,
                          const LoadCurve &value);

   /// Traction value x n of the solid alone, to which the fluid's pressure
   /// adds (stress). Throws Error in infinitesimal deformation.
   void AddEffectiveTraction(const mfem::Array<int> &boundary,
                             const LoadCurve &value);

   /// Springs on a fixed base, as SpringFoundation has them.
   void AddSprings(const mfem::Array<int> &boundary, mfem::real_t stiffness,
                   const mfem::Vector &direction = mfem::Vector());

   /// Moves a boundary rigidly along @a direction, of any length but zero, by
   /// the resultant @a force (force) in that direction, as RigidSurfaces has
   /// it.
   /// @a name is for messages.
   void DriveByForce(const mfem::Array<int> &boundary,
                     const mfem::Vector &direction, const LoadCurve &force,
                     const std::string &name = "");

   /// Ties a boundary to a rigid body, as RigidTies has it. Throws Error for a
   /// load or a spring on a prescribed freedom.
   void AddRigidBody(const RigidBody &body);

   /// Joins rigid bodies, which must have been added before. Throws Error for a
   /// ligament that has a Contradiction().
   void AddLigament(const Ligament &ligament);
   /// Likewise.
   void AddJoint(const Joint &joint);

   /// Lets no fluid pass where it would drain as a surface of a contact pair.
   void Seal(const mfem::Array<int> &boundary);

   /// Outward relative flux -kappa grad p . n (length / time). A curve follows
   /// finite deformation; a coefficient is per undeformed area.
   void AddNormalFlux(const mfem::Array<int> &boundary, const LoadCurve &value);
   void AddNormalFlux(const mfem::Array<int> &boundary,
                      mfem::Coefficient &value);

   /// Outward flux of fluid and solid together (length / time), per deformed
   /// area. Throws Error in infinitesimal deformation.
   void AddMixtureFlux(const mfem::Array<int> &boundary,
                       const LoadCurve &value);

   /// Body force (force / volume) and fluid source (1 / time).
   void AddBodyForce(mfem::VectorCoefficient &value);
   void AddFluidSource(mfem::Coefficient &value);

   /// Forces and flows to nodes (volume / time), true dofs, for a curve of 1.
   void AddLoads(const mfem::Vector &forces, const mfem::Vector &inflow,
                 const LoadCurve &curve);
   /// For loads that are not conditions here: steps end on its corners.
   void AddCorners(const LoadCurve &curve);

   /// Prescribed true dofs, ascending.
   const mfem::Array<int> &DisplacementDofs() const { return u_dofs; }
   const mfem::Array<int> &PressureDofs() const { return p_dofs; }

   /// Lets the increments that are prescribed since time @a t count from the
   /// displacement @a u, true dofs.
   void SetOrigins(mfem::real_t t, const mfem::Vector &u);
   /// Lists what increments count from, if there are any. Collective.
   void Archive(StateArchive &archive);

   /// Writes the prescribed values at time @a t into true-dof vectors.
   void SetDisplacement(mfem::real_t t, mfem::Vector &u);
   void SetPressure(mfem::real_t t, mfem::Vector &p);

   /// Sets the loads at time @a t, true-dof vectors: @a momentum in force,
   /// @a mass in volume / time (sources less prescribed outflow).
   void GetLoads(mfem::real_t t, mfem::Vector &momentum, mfem::Vector &mass);

   /// No part of GetLoads(), as they depend on the displacement.
   const FollowerLoads &Followers() const { return followers; }

   /// Attributes of sealed boundaries.
   const mfem::Array<int> &Sealed() const { return sealed; }

   const std::vector<SpringFoundation> &Springs() const { return springs; }

   const std::vector<DrivenSurface> &DrivenSurfaces() const { return driven; }

   const std::vector<RigidBody> &RigidBodies() const { return rigid_bodies; }
   const std::vector<Ligament> &Ligaments() const { return ligaments; }
   const std::vector<Joint> &Joints() const { return joints; }
   Deformation GetDeformation() const { return deformation; }

   /// Where load curves have corners, ascending, each once.
   const std::vector<mfem::real_t> &Corners() const { return corners; }

private:
   struct CurveValue
   {
      mfem::Array<int> dofs;
      LoadCurve curve;
   };
   /// Displacements relative to those of its dofs at the time since.
   struct Increment
   {
      mfem::Array<int> dofs;
      LoadCurve curve;
      mfem::real_t since;
      mfem::Vector origin;
   };
   struct CurveLoad
   {
      mfem::Vector load;
      LoadCurve curve;
   };
   struct FieldValue
   {
      mfem::Array<int> dofs;
      mfem::Array<int> marker;
      mfem::VectorCoefficient *vector;
      mfem::Coefficient *scalar;
   };
   /// A linear form whose coefficient depends on time, and its markers.
   struct FieldLoad
   {
      std::vector<std::unique_ptr<mfem::Array<int>>> markers;
      std::vector<std::unique_ptr<mfem::Coefficient>> own_scalars;
      std::unique_ptr<mfem::ParLinearForm> form;
      std::vector<mfem::VectorCoefficient *> vectors;
      std::vector<mfem::Coefficient *> scalars;

      void AddTo(mfem::real_t t, mfem::Vector &load);
   };

   std::vector<std::string> RigidBodyNames() const;
   mfem::Array<int> Marker(const mfem::Array<int> &boundary) const;
   mfem::Array<int> Dofs(mfem::ParFiniteElementSpace &space,
                         const mfem::Array<int> &boundary, int component,
                         mfem::Array<int> &all) const;
   FieldLoad &MomentumForm();
   FieldLoad &MassForm();

   BiphasicSpaces &spaces;
   Deformation deformation;
   FollowerLoads followers;
   mfem::Array<int> u_dofs;
   mfem::Array<int> p_dofs;
   mfem::Array<int> dry_dofs;
   mfem::Array<int> sealed;
   std::vector<CurveValue> u_values;
   std::vector<Increment> increments;
   std::vector<CurveValue> p_values;
   std::vector<FieldValue> u_fields;
   std::vector<FieldValue> p_fields;
   std::vector<CurveLoad> momentum_loads;
   std::vector<CurveLoad> mass_loads;
   std::vector<SpringFoundation> springs;
   std::vector<DrivenSurface> driven;
   std::vector<RigidBody> rigid_bodies;
   std::vector<Ligament> ligaments;
   std::vector<Joint> joints;
   FieldLoad momentum_form;
   FieldLoad mass_form;
   std::vector<mfem::real_t> corners;
};

} // namespace synovia
