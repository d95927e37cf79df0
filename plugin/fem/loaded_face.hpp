#pragma once

#include "synovia/fem/biphasic_spaces.hpp"
#include "synovia/general/point3.hpp"

namespace synovia
{

/// Walks through the quadrature points of the deformed faces of a boundary,
/// with the shape functions of displacement and pressure there.
class LoadedFace
{
public:
   /// Borrows @a spaces.
   explicit LoadedFace(BiphasicSpaces &spaces);

   /// Takes a boundary element of the mesh, displaced by @a u, local dofs.
   void Set(int boundary_element, const mfem::Vector &u);
   int Points() const { return rule->GetNPoints(); }
   /// Moves to a point of the face.
   void SetPoint(int point);

   /// Local vector dofs, component by component, and dofs of the pressure.
   const mfem::Array<int> &DisplacementDofs() const { return u_dofs; }
   const mfem::Array<int> &PressureDofs() const { return p_dofs; }
   /// Shape functions of the displacement, and those of the pressure.
   const mfem::Vector &Shape() const { return shape; }
   const mfem::Vector &PressureShape() const { return p_shape; }

   /// Of the quadrature; negative in some rules.
   mfem::real_t Weight() const { return weight; }
   /// Deformed area by area of the reference face, along the outward normal.
   const Point3 &Area() const { return area; }
   /// The derivative of that area with the displacement of a node: for a
   /// displacement d it is d x AreaChange(node).
   Point3 AreaChange(int node) const;

private:
   BiphasicSpaces &spaces;
   const mfem::FiniteElement *u_element = nullptr;
   const mfem::FiniteElement *p_element = nullptr;
   mfem::IsoparametricTransformation trans;
   const mfem::IntegrationRule *rule = nullptr;
   mfem::Array<int> u_dofs;
   mfem::Array<int> p_dofs;
   mfem::Vector u_values;
   mfem::Vector shape;
   mfem::Vector p_shape;
   /// By the coordinates of the reference face, nodes x 2.
   mfem::DenseMatrix slopes;
   mfem::real_t weight = 0.0;
   Point3 tangents[2];
   Point3 area;
};

} // namespace synovia
