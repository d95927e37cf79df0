#pragma once

#include "synovia/fem/gravity_loads.hpp"
#include "synovia/materials/deformation.hpp"
#include "synovia/mesh/named_mesh.hpp"
#include "synovia/physics/biphasic_operator.hpp"

#include <array>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace synovia
{

struct SpaceOptions
{
   /// Order of the displacement; 1 is stabilized equal order.
   int order = 2;
   Deformation deformation = Deformation::infinitesimal;
   /// Factor on the stabilization of order 1, from 0 to 1.
   mfem::real_t stabilization = 1.0;
};

/// A biphasic problem by names: bodies, materials, boundary conditions,
/// contact.
///
/// Units are the caller's own consistent set. Set everything, then call
/// Operator() or hand the problem to a TimeStepper; from then on nothing can be
/// set any more. Members that take a name throw Error if there is no such name.
/// All members are collective.
///
/// Large because each kind of condition has a member.
class BiphasicProblem
{
public:
   /// Borrows @a mesh.
   BiphasicProblem(NamedMesh &mesh, const SpaceOptions &options);

   /// Borrows the laws. A later call replaces an earlier one.
   void SetMaterial(const std::string &region, const SolidLaw &solid,
                    const PermeabilityLaw &permeability,
                    mfem::real_t solid_fraction = 0.2);
   /// An elastic solid without fluid: others see a sealed wall in it.
   void SetMaterial(const std::string &region, const SolidLaw &solid);
   /// The same with all that a material has. Throws Error if mean_dilatation is
   /// asked of displacements of order 2 or more.
   void SetMaterial(const std::string &region, const Material &material);

   /// A force per mass on all bodies with densities, such as gravity, by
   /// component (length / time^2).
   void SetAcceleration(const std::array<LoadCurve, 3> &acceleration);
   /// At a time; zero if there is none.
   Point3 Acceleration(mfem::real_t t) const;

   /// All components zero.
   void FixDisplacement(const std::string &boundary);
   /// One component (0, 1, 2) in time (length).
   void PrescribeDisplacement(const std::string &boundary, int component,
                              const LoadCurve &value);
   /// How far one component is from what it is at the time @a since, when
   /// TimeStepper::BeginAnew() is called; from 0 until then (length).
   void PrescribeIncrement(const std::string &boundary, int component,
                           const LoadCurve &value, mfem::real_t since);
   /// Fluid pressure, positive in compression (stress).
   void PrescribePressure(const std::string &boundary, const LoadCurve &value);
   /// Total traction: direction x value (stress); in finite deformation per
   /// undeformed area.
   void AddTraction(const std::string &boundary, const mfem::Vector &direction,
                    const LoadCurve &value);
   /// Total traction along the outward normal, positive in tension (stress); in
   /// finite deformation along the current one, per current area.
   void AddNormalTraction(const std::string &boundary, const LoadCurve &value);
   void AddMixtureFlux(const std::string &boundary, const LoadCurve &value);
   void AddEffectiveTraction(const std::string &boundary,
                             const LoadCurve &value);
   /// Springs on a fixed base with this total stiffness (force / length), along
   /// @a direction, of any length but zero, or alike in all directions if that
   /// is empty.
   void AddSprings(const std::vector<std::string> &boundaries,
                   mfem::real_t stiffness,
                   const mfem::Vector &direction = mfem::Vector());
   /// Lets boundaries slide along a plane across @a direction, of any length
   /// but zero: springs across it hold them that give way by 1e-6 of what a
   /// stress compresses as much of the body as the boundaries are wide. The
   /// materials behind must have been set.
   void AddGuide(const std::vector<std::string> &boundaries,
                 const Point3 &direction);
   /// Moves boundaries, together one rigid surface, along @a direction by the
   /// resultant @a force (force). Components that are zero in @a direction are
   /// free unless they are prescribed.
   void DriveByForce(const std::vector<std::string> &boundaries,
                     const mfem::Vector &direction, const LoadCurve &force);
   /// Ties boundaries to a rigid body, which moves them exactly, by rotations
   /// of any size in finite deformation; @a regions are parts of it, and have
   /// no material.
   void AddRigidBody(const std::string &name,
                     const std::vector<std::string> &boundaries,
                     const RigidBodyOptions &options,
                     const std::vector<std::string> &regions = {});
   /// Joins two rigid bodies, or one and space, which must have been added
   /// before.
   void AddLigament(const Ligament &ligament);
   /// Reports how two rigid bodies, or one and space, are placed beside each
   /// other, and drives what the joint prescribes of it; they must have been
   /// added before.
   void AddJoint(const Joint &joint);
   /// Outward relative flux (length / time), per current area in finite
   /// deformation.
   void AddNormalFlux(const std::string &boundary, const LoadCurve &value);

   /// Lets no fluid pass through a boundary of a contact pair where nothing
   /// touches it.
   void Seal(const std::string &boundary);

   /// Lets two boundaries touch. Boundaries of contact pairs drain freely where
   /// no pair seals them, unless they are sealed by Seal().
   void AddContact(const std::string &source, const std::string &destination,
                   const ContactOptions &options = ContactOptions(),
                   const std::string &name = "");
   /// The same for sides of several boundaries each, at least one.
   void AddContact(const std::vector<std::string> &sources,
                   const std::vector<std::string> &destinations,
                   const ContactOptions &options, const std::string &name);

   /// Glues boundaries of different bodies, whose meshes need not match:
   /// displacement and fluid pressure are continuous across them. Boundaries of
   /// the @a destinations carry the tractions: the finer side. Where one side
   /// has no fluid, the other is sealed.
   void AddTie(const std::vector<std::string> &sources,
               const std::vector<std::string> &destinations,
               const TieOptions &options = TieOptions(),
               const std::string &name = "");

   void SetNonlinearOptions(const NonlinearOptions &options);

   /// For conditions that have no name here, such as coefficients.
   BoundaryConditions &Conditions() { return *conditions; }

   Deformation GetDeformation() const { return deformation; }
   NamedMesh &Mesh() { return mesh; }
   BiphasicSpaces &Spaces() { return spaces; }
   const MaterialTable &Materials() const { return materials; }

   /// Throws Error if a region has no material, or one whose laws can't be used
   /// in one of its elements (see VerifyLaws()). Collective.
   void VerifyMaterials();

   /// Throws Error if a pressure or a flux is prescribed on a boundary behind
   /// which no region has fluid. Every region must have a material. Collective.
   void VerifyFluid();

   /// What moves together: regions that share vertices or are tied.
   std::vector<Body> Bodies();

   /// Assembled at the first call, after VerifyMaterials().
   BiphasicOperator &Operator();

   /// Boundaries with prescribed or driven displacements, and which components
   /// are.
   struct Support
   {
      std::string boundary;
      std::array<bool, 3> components{{false, false, false}};
   };
   const std::vector<Support> &Supports() const { return supports; }

   /// Names for the springs of Conditions().Springs() that AddSprings() has
   /// added, in order: that of their first boundary.
   const std::vector<std::string> &SpringNames() const { return spring_names; }

   /// Force that a support exerts on the body in its prescribed components, at
   /// the last stage. A dof of two supports counts in both.
   Point3 Reaction(const Support &support);

   /// A rigid body at the last stage.
   struct RigidBodyState
   {
      std::string name;
      RigidPose pose{};
      /// What loads, springs, ligaments and supports exert on the body, and it
      /// on what is tied to it (force, force x length); the moment is about the
      /// reference point, where that is now.
      Point3 force{};
      Point3 moment{};
   };
   /// In the order in which they were added.
   std::vector<RigidBodyState> RigidBodyStates();

   /// A ligament at the last stage.
   struct LigamentState
   {
      std::string name;
      mfem::real_t length = 0.0;
      /// Tension positive (force).
      mfem::real_t force = 0.0;
   };
   /// In the order in which they were added.
   std::vector<LigamentState> LigamentStates();

   /// A joint at the last stage.
   struct JointState : Joints::State
   {
      std::string name;
      std::array<bool, 6> prescribed{};
   };
   /// In the order in which they were added.
   std::vector<JointState> JointStates();

private:
   mfem::Array<int> Boundaries(const std::vector<std::string> &names) const;
   Support &SupportOf(const std::string &boundary);
   void VerifyOpen() const;
   /// Remembers a boundary that must have fluid behind it.
   void NeedFluid(const std::string &boundary);
   void AddGravity();
   std::unique_ptr<BodyForm> MakeBodies();
   /// Throws Error where a surface of a tie may touch another as well.
   void VerifyTies() const;

   NamedMesh &mesh;
   Deformation deformation;
   BiphasicSpaces spaces;
   MaterialTable materials;
   std::unique_ptr<BoundaryConditions> conditions;
   std::vector<std::unique_ptr<ContactPair>> pairs;
   struct PairSetup
   {
      mfem::Array<int> source;
      mfem::Array<int> destination;
      ContactOptions options;
      std::string name;
   };
   std::vector<PairSetup> pair_setups;
   std::vector<std::unique_ptr<TiedInterface>> interfaces;
   struct TieSetup
   {
      mfem::Array<int> source;
      mfem::Array<int> destination;
      TieOptions options;
      std::string name;
   };
   std::vector<TieSetup> tie_setups;
   NonlinearOptions nonlinear;
   std::vector<Support> supports;
   std::vector<std::string> spring_names;
   std::set<std::string> with_fluid;
   std::optional<std::array<LoadCurve, 3>> acceleration;
   /// In finite deformation.
   std::unique_ptr<GravityLoads> gravity;
   std::unique_ptr<BiphasicOperator> op;
};

} // namespace synovia
