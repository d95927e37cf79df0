#pragma once

#include "synovia/fem/volume_matrices.hpp"

#include <optional>
#include <string>

namespace synovia
{

/// One implicit stage of the bodies: where it begins, how long it is, and the
/// state to be evaluated at its end. True dofs.
struct BodyStage
{
   /// Length and end (time).
   mfem::real_t dt = 0.0;
   mfem::real_t time = 0.0;
   mfem::Vector u0;
   mfem::Vector p0;
   /// What BodyForm::GetConserved() is at the beginning, as the time scheme
   /// combines it from earlier stages.
   mfem::Vector conserved0;
   mfem::Vector u;
   mfem::Vector p;
};

/// The bodies' part of momentum and mass balance: stresses and springs, growth
/// of volume and flow of fluid, loads that follow the deformation, and the
/// derivatives of all these. Other loads, supports and contact are not part of
/// it.
///
/// All members are collective. Momentum is in force, mass in volume of fluid in
/// the stage. Large because parts of the balances are asked for one by one.
class BodyForm
{
public:
   virtual ~BodyForm() = default;

   /// Number of conserved quantities on this rank besides u and p, which time
   /// schemes treat as part of the state.
   virtual int ConservedSize() const { return 0; }
   /// Sets them for a displacement: none, if the growth of volume is linear in
   /// it, else the volume ratio J at each quadrature point.
   virtual void GetConserved(const mfem::Vector &,
                             mfem::Vector &conserved) const
   {
      conserved.SetSize(0);
   }

   /// Called once before the iterations of a stage. @a pressure_rate is what
   /// the pressure's rate is expected to be (stress / time), from a stage of
   /// length @a rate_dt.
   virtual void StartStage(const BodyStage &stage,
                           const mfem::Vector &pressure_rate,
                           mfem::real_t rate_dt) = 0;

   /// Forces that the bodies exert on their nodes' supports, and the volume
   /// that each node's surroundings gain and lose: zero in balance without
   /// loads.
   virtual void Mult(const BodyStage &stage, mfem::Vector &momentum,
                     mfem::Vector &mass) const = 0;

   /// Mult() at the stage's end, extrapolated from the stage's beginning with
   /// the Tangent(), which must be the one at the beginning: large increments
   /// at supports alone may invert elements.
   virtual void MultFromStart(const BodyStage &stage, mfem::Vector &momentum,
                              mfem::Vector &mass) const = 0;

   /// The growth of the bodies' volume in the mass balance.
   virtual void GetGrowth(const BodyStage &stage,
                          mfem::Vector &growth) const = 0;

   /// Adds the forces of loads that follow the deformation, of which Mult()
   /// has the reverse (true dofs).
   virtual void AddLoads(const BodyStage &, mfem::Vector &) const {}

   /// What loads that follow the deformation let into this rank's bodies
   /// (volume / time).
   virtual mfem::real_t Inflow(const BodyStage &) const { return 0.0; }

   /// What vessels let into this rank's bodies (volume / time); none, on all
   /// ranks, where there are no vessels.
   virtual std::optional<mfem::real_t> Supply(const BodyStage &) const
   {
      return std::nullopt;
   }

   /// Adds the magnitudes of the terms that cancel in Mult(), for absolute
   /// values of @a u and @a p: what round-off is relative to.
   virtual void AddMagnitudes(mfem::real_t dt, const mfem::Vector &u,
                              const mfem::Vector &p, mfem::Vector &momentum,
                              mfem::Vector &mass) const = 0;

   /// On all ranks, the reason why the state at the end of @a stage is
   /// impossible, such as an inverted element, with region and place; empty if
   /// it is possible.
   virtual std::string Validate(const BodyStage &stage) const = 0;

   /// Whether Tangent() is the same in all states.
   virtual bool IsLinear() const = 0;

   /// Damps Tangent(), from the next Linearize() of this stage on, or damps it
   /// more, where a @a direction of the displacement (true dofs) would deform
   /// bodies too much; says whether there are such places that it was not
   /// damped most at.
   virtual bool Damp(const BodyStage &, const mfem::Vector &) { return false; }
   /// Damps it less.
   virtual void EaseDamping() {}
   /// Adds what the damping in Tangent() resists a @a displacement with to
   /// @a forces (true dofs). Collective.
   virtual void AddDampingForces(const mfem::Vector &, mfem::Vector &) const {}

   /// Brings Tangent() to the state of @a stage; says whether it changed.
   virtual bool Linearize(const BodyStage &stage) = 0;

   /// The matrices of the derivative, as BiphasicJacobian has them.
   virtual const VolumeMatrices &Tangent() const = 0;
};

} // namespace synovia
