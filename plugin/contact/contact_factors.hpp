#pragma once

#include "mfem.hpp"

#include <vector>

namespace synovia
{

/// Terms of a contact pair in the linearized equations of a stage, as factors
/// of true-dof matrices; m are the destination's vertices (SurfaceVertices):
///
///     momentum:  (G^T W R + force_change) du + force_by_pressure dp
///     mass:      dt (J^T W_p jump_change + outflow_change) du
///                + dt J^T W_p J dp
///
/// with the diagonal W and W_p. Momentum counts forces that the nodes exert,
/// mass what leaves them. In infinitesimal contact R is G, the same object, and
/// there are no changes. All is borrowed, and good until the pair searches,
/// evaluates or updates its active set.
struct ContactFactors
{
   /// G, m x displacement (dimensionless): nodal forces are -G^T (area t).
   const mfem::HypreParMatrix *gap = nullptr;
   /// R = dg/du, m x displacement (dimensionless).
   const mfem::HypreParMatrix *gap_change = nullptr;
   /// J, m x pressure (dimensionless): the fluid that leaves the nodes is
   /// J^T (area q).
   const mfem::HypreParMatrix *jump = nullptr;
   /// d(J p)/du at fixed p, m x displacement (stress / length); null for none.
   const mfem::HypreParMatrix *jump_change = nullptr;
   /// d(G^T (area t))/du at fixed t, displacement x displacement (force /
   /// length); null for none.
   const mfem::HypreParMatrix *force_change = nullptr;
   /// What stands for force_change in a multigrid hierarchy: what sticks is
   /// held no harder there than bodies resist, and what slides is free. Null
   /// for force_change itself.
   const mfem::HypreParMatrix *soft_force_change = nullptr;
   /// d(D^T (area t))/dp with the tangential tractions t of friction,
   /// displacement x pressure (area); null for none. The other derivatives of
   /// friction are in force_change.
   const mfem::HypreParMatrix *force_by_pressure = nullptr;
   /// d(J^T (area q))/du at fixed q, pressure x displacement (area / time);
   /// null for none.
   const mfem::HypreParMatrix *outflow_change = nullptr;
   /// W: area x penalty where the surfaces touch, else 0 (force / length).
   const mfem::Vector *gap_weights = nullptr;
   /// W_p: area x penalty where a jump is to close, else 0 (volume / time /
   /// stress).
   const mfem::Vector *jump_weights = nullptr;
   /// g and J p at the last state (length; stress), where multipliers may be
   /// solved for; null where penalties alone close them in a Newton step, as
   /// friction follows what they make of the gaps.
   const mfem::Vector *gap_values = nullptr;
   const mfem::Vector *jump_values = nullptr;
   /// Area x what the bodies resist (force / length): weights of gaps that are
   /// cut off there still hold the surfaces together, but no harder than the
   /// bodies themselves.
   const mfem::Vector *gap_resistance = nullptr;

   /// Whether momentum is symmetric in the displacement.
   bool IsSymmetric() const
   {
      return gap_change == gap && !force_change && !force_by_pressure;
   }
   /// Whether mass has nothing of the displacement.
   bool IsUncoupled() const { return !jump_change && !outflow_change; }
};

/// Of all pairs of a problem, in order.
using ContactTerms = std::vector<ContactFactors>;

} // namespace synovia
