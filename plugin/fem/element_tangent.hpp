#pragma once

#include "synovia/fem/body_element.hpp"
#include "synovia/fem/element_permeability.hpp"
#include "synovia/fem/mean_dilatation.hpp"
#include "synovia/materials/material_table.hpp"

namespace synovia
{

/// The derivative of the integrals over an element of a deforming body by its
/// displacement u and pressure p, as matrices by its dofs:
///
///     stiffness    int grad w : [dP_e/dF - p d(J F^-T)/dF] : grad du
///     growth       int q J F^-T : grad du
///     flow_change  dt int grad q . (dK/dF : grad du) grad p
///                  - dt int q kp (pc - p) J F^-T : grad du
///     darcy        int grad q . K grad dp + int q J kp dp
class ElementTangent
{
public:
   explicit ElementTangent(const BiphasicSpaces &spaces) : permeability(spaces)
   {
   }

   /// Of the element that @a element is set to; false if its state is one that
   /// a law does not allow.
   bool Compute(BodyElement &element, const Material &material,
                mfem::real_t dt);

   mfem::DenseMatrix stiffness;
   mfem::DenseMatrix growth;
   mfem::DenseMatrix flow_change;
   mfem::DenseMatrix darcy;

private:
   /// The derivative of the stress at a point by F there; false where the law
   /// has none.
   bool GetSolidTangent(BodyElement &element, const Material &material,
                        int point, Tangent3 &solid);

   MeanDilatation mean_dilatation;
   ElementPermeability permeability;
   // Gradients of shape functions contracted with tensors, all points beside
   // each other: factors of the products that make the matrices.
   mfem::DenseMatrix stress_changes;
   mfem::DenseMatrix volume_changes;
   mfem::DenseMatrix flow_changes;
   mfem::DenseMatrix flows;
   mfem::DenseMatrix supplies;
   mfem::DenseMatrix stiffness_rows;
   /// The change of what flows to nodes with the mean volume ratio.
   mfem::Vector mean_flow;

   /// Adds what the mean's change with all points' deformation makes flow.
   void AddMeanCoupling(BodyElement &element);
   /// Adds what the supply changes, with the other terms there already.
   void AddSupply(BodyElement &element, const FluidSupply &supply,
                  mfem::real_t dt);
};

} // namespace synovia
