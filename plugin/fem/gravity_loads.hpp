#pragma once

#include "synovia/fem/body_element.hpp"
#include "synovia/fem/element_permeability.hpp"
#include "synovia/fem/follower_loads.hpp"
#include "synovia/materials/material_table.hpp"

#include <array>
#include <optional>

namespace synovia
{

/// A force per mass, such as gravity, on bodies of finite deformation: with the
/// true densities rho_s, rho_f and the solid fraction phi_0,
///
///     momentum:  int (phi_0 rho_s + (J - phi_0) rho_f) b . w
///     mass:      int grad q . K rho_f F^T b
///
/// over the undeformed bodies; those without fluid have rho_s alone. The fluid
/// flows by grad p - rho_f b in space.
class GravityLoads
{
public:
   /// Borrows both. @a acceleration is b in time (length / time^2).
   GravityLoads(BiphasicSpaces &spaces, const MaterialTable &materials,
                const std::array<LoadCurve, 3> &acceleration);

   /// Adds forces and flows to nodes (volume / time) as FollowerLoads does; not
   /// finite where a body has no permeability.
   void AddLoads(const FollowerLoads::State &state, mfem::Vector &forces,
                 mfem::Vector &inflow) const;
   /// Subtracts their derivatives by the displacement, as FollowerLoads does.
   void AddDerivatives(const FollowerLoads::State &state,
                       AssembledMatrix &stiffness,
                       AssembledMatrix &flow_change) const;

private:
   /// Values of the displacement's shape functions at the element's points,
   /// nodes x points.
   const mfem::DenseMatrix &Shapes(int element) const;
   Vector3<> Acceleration(mfem::real_t t) const;

   BiphasicSpaces &spaces;
   const MaterialTable &materials;
   std::array<LoadCurve, 3> acceleration;
   mutable BodyElement element;
   mutable ElementPermeability permeability;
   mutable std::map<mfem::Geometry::Type, mfem::DenseMatrix> shapes_of;
};

/// What GravityLoads are in infinitesimal strain, for an acceleration of 1
/// along an axis: @a forces, and flows to nodes (volume / time). True dofs.
/// Collective.
void AssembleGravity(BiphasicSpaces &spaces, const MaterialTable &materials,
                     int axis, mfem::Vector &forces, mfem::Vector &inflow);

} // namespace synovia
