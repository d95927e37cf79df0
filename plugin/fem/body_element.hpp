#pragma once

#include "synovia/fem/biphasic_spaces.hpp"
#include "synovia/materials/material_point.hpp"
#include "synovia/materials/tensor3.hpp"

namespace synovia
{

/// Walks through the quadrature points of the elements of a biphasic mesh, with
/// what integrals over undeformed bodies need at each: shape functions and
/// gradients by the undeformed coordinates, and deformation and pressure there.
class BodyElement
{
public:
   /// Borrows @a spaces.
   explicit BodyElement(BiphasicSpaces &spaces);

   /// Takes an element with the values of @a u and @a p, local dofs.
   void Set(int element, const mfem::Vector &u, const mfem::Vector &p);
   int Points() const { return rule->GetNPoints(); }
   /// How many points all elements of this rank have.
   int AllPoints();

   /// Moves to a point of the element.
   void SetPoint(int point);

   int Attribute() const { return trans->Attribute; }
   MaterialPoint Point() const { return {*trans, *ip}; }
   /// Undeformed coordinates.
   mfem::Vector Position() const;

   /// Local vector dofs of the displacement, component by component, and dofs
   /// of the pressure.
   const mfem::Array<int> &DisplacementDofs() const { return u_dofs; }
   const mfem::Array<int> &PressureDofs() const { return p_dofs; }

   /// Shape functions of the displacement: gradients, nodes x 3.
   const mfem::DenseMatrix &Gradients() const { return gradients; }
   /// Those of the pressure, and their gradients, dofs x 3.
   const mfem::Vector &PressureShape() const { return p_shape; }
   const mfem::DenseMatrix &PressureGradients() const { return p_gradients; }

   /// Undeformed volume that the point stands for.
   mfem::real_t Weight() const { return weight; }
   /// F = I + grad u.
   const Tensor3<> &DeformationGradient() const { return F; }
   mfem::real_t Pressure() const { return p; }
   const Vector3<> &PressureGradient() const { return grad_p; }

private:
   const mfem::IntegrationRule &Rule(int element);

   BiphasicSpaces &spaces;
   const mfem::FiniteElement *u_element = nullptr;
   const mfem::FiniteElement *p_element = nullptr;
   mfem::ElementTransformation *trans = nullptr;
   const mfem::IntegrationRule *rule = nullptr;
   const mfem::IntegrationPoint *ip = nullptr;
   const mfem::DofToQuad *u_maps = nullptr;
   const mfem::DofToQuad *p_maps = nullptr;
   mfem::Array<int> u_dofs;
   mfem::Array<int> p_dofs;
   mfem::Vector u_values;
   mfem::Vector p_values;
   mfem::DenseMatrix reference;
   mfem::DenseMatrix gradients;
   mfem::DenseMatrix p_reference;
   mfem::DenseMatrix p_gradients;
   mfem::Vector p_shape;
   mfem::real_t weight = 0.0;
   Tensor3<> F;
   mfem::real_t p = 0.0;
   Vector3<> grad_p;
};

} // namespace synovia
