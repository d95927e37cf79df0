#pragma once

#include "synovia/fem/biphasic_spaces.hpp"
#include "synovia/materials/material_point.hpp"
#include "synovia/materials/tensor3.hpp"

#include <map>
#include <vector>

namespace synovia
{

/// Which points of elements BodyElement has.
enum class ElementPoints
{
   /// Of a quadrature for the sides that elements have.
   as_meshed,
   /// Fewer, where sides are curved: enough for what need not be exact.
   straight,
   /// Their corners, which stand for equal parts of the reference element.
   corners
};

/// Walks through the elements of a biphasic mesh, with what integrals over
/// undeformed bodies need at all quadrature points of an element at once: shape
/// functions and gradients by the undeformed coordinates, and deformation and
/// pressure there.
///
/// Weights and inverse Jacobians are computed once: ten numbers for each point
/// are kept.
///
/// Large because it names each of the values that an integrand is made of.
class BodyElement
{
public:
   /// Borrows @a spaces.
   explicit BodyElement(BiphasicSpaces &spaces,
                        ElementPoints points = ElementPoints::as_meshed);

   /// How many points all elements of this rank have.
   int AllPoints() const { return begins.back(); }

   /// Takes an element with the values of @a u and @a p, local dofs.
   void Set(int element, const mfem::Vector &u, const mfem::Vector &p);
   int Points() const { return tables->rule->GetNPoints(); }
   /// The number of the element's first point among all.
   int FirstPoint() const { return begins[current]; }

   int Attribute() const { return trans.Attribute; }
   MaterialPoint Point(int point);
   /// Undeformed coordinates.
   mfem::Vector Position(int point);

   /// Local vector dofs of the displacement, component by component, and dofs
   /// of the pressure.
   const mfem::Array<int> &DisplacementDofs() const { return u_dofs; }
   const mfem::Array<int> &PressureDofs() const { return p_dofs; }

   /// Shape functions of the displacement: gradients, nodes x (3 x points), the
   /// components of a point one after the other. Found when asked for.
   const mfem::DenseMatrix &Gradients();
   /// Those of the pressure, dofs x points, and their gradients likewise.
   const mfem::DenseMatrix &PressureShapes() const { return tables->p_shapes; }
   const mfem::DenseMatrix &PressureGradients();
   /// The same by reference coordinates, which all elements of a shape share.
   const mfem::DenseMatrix &Slopes() const { return tables->slopes; }
   const mfem::DenseMatrix &PressureSlopes() const { return tables->p_slopes; }
   /// A vector in undeformed coordinates, at a point, in reference coordinates:
   /// its product with a gradient equals the product of the result with the
   /// slope.
   Vector3<> ToReference(int point, const Vector3<> &vector) const;

   /// Undeformed volume that a point stands for.
   mfem::real_t Weight(int point) const
   {
      return weights[begins[current] + point];
   }
   /// F = I + grad u.
   Tensor3<> DeformationGradient(int point) const;
   mfem::real_t Pressure(int point) const { return pressures[point]; }
   Vector3<> PressureGradient(int point) const
   {
      return ToBody(point, &pressure_slopes[3 * point]);
   }

private:
   /// Of the elements of one shape, gradients on the reference element.
   struct Tables
   {
      const mfem::IntegrationRule *rule;
      mfem::DenseMatrix slopes;
      mfem::DenseMatrix p_shapes;
      mfem::DenseMatrix p_slopes;
   };
   Tables Tabulate(int element, ElementPoints points);
   void KeepGeometry();
   /// Of a point, dxi_c / dx_b at 3 c + b.
   const mfem::real_t *InverseJacobian(int point) const
   {
      return inverse_jacobians.data() +
             9 * (begins[current] + static_cast<size_t>(point));
   }
   /// slopes x inverse Jacobian, point by point, and at one.
   void ToBody(const mfem::DenseMatrix &slopes,
               mfem::DenseMatrix &gradients) const;
   Vector3<> ToBody(int point, const mfem::real_t *slope) const;

   BiphasicSpaces &spaces;
   std::map<mfem::Geometry::Type, Tables> tables_of;
   /// Where the points of each element begin, and one more.
   std::vector<int> begins;
   std::vector<mfem::real_t> weights;
   /// Nine for each point, row by row.
   std::vector<mfem::real_t> inverse_jacobians;

   int current = 0;
   const Tables *tables = nullptr;
   mfem::IsoparametricTransformation trans;
   mfem::Array<int> u_dofs;
   mfem::Array<int> p_dofs;
   mfem::Vector u_values;
   mfem::Vector p_values;
   /// Empty until they are asked for.
   mfem::DenseMatrix gradients;
   mfem::DenseMatrix p_gradients;
   bool gradients_known = false;
   bool p_gradients_known = false;
   /// By reference coordinates, (3 x points) x 3 and 3 x points.
   mfem::DenseMatrix displacement_slopes;
   mfem::Vector pressure_slopes;
   mfem::Vector pressures;
};

} // namespace synovia
