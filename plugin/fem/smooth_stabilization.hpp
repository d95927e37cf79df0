#pragma once

#include "synovia/fem/biphasic_spaces.hpp"
#include "synovia/general/point3.hpp"
#include "synovia/materials/material_table.hpp"

namespace synovia
{

/// The pressure projection's effect on the smooth part of a pressure field.
///
/// PressureProjectionIntegrator cannot tell an oscillation from a gradient: in
/// thin, nearly undrained layers the latter's share acts like a permeability of
/// h^2 tau / (12 t), which may be far more than the tissue's own. The smooth
/// part is told apart by the elements around: its gradient has, component by
/// component, the least magnitude among an element and all those that share a
/// vertex with it, and is zero where their signs differ. An oscillation from
/// node to node has no smooth part, nor has a layer at a boundary thinner than
/// an element; a linear field is all smooth.
///
/// Orthogonal subscales (Codina & Blasco, CMAME 143:373-391, 1997) tell them
/// apart by a projection instead, which widens the matrix's stencil and lets
/// boundary layers oscillate. Here the smooth part is taken of a guess, and its
/// effect goes to the right side.
class SmoothStabilization
{
public:
   /// For the pressure space of order 1 of @a spaces, borrowed. Collective.
   SmoothStabilization(BiphasicSpaces &spaces, const MaterialTable &materials);

   /// y = S p_smooth, true dofs; homogeneous, but not linear, in p. Its sum is
   /// zero: no fluid gets lost. Collective.
   void Mult(const mfem::Vector &p, mfem::Vector &y) const;

private:
   struct Element
   {
      mfem::Array<int> dofs;
      /// Of the shape functions at the center, dofs x 3.
      mfem::DenseMatrix gradients;
      /// Positions of the dofs, dofs x 3.
      mfem::DenseMatrix nodes;
      mfem::DenseMatrix stabilization;
   };

   /// At each vertex (local dof) the component of least magnitude among the
   /// elements around; zero if its signs differ.
   mfem::Vector LeastAround(const std::vector<Point3> &gradients,
                            int component) const;

   mfem::ParFiniteElementSpace &space;
   /// Those with fluid.
   std::vector<Element> elements;
};

} // namespace synovia
