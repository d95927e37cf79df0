#pragma once

#include "synovia/mesh/named_mesh.hpp"

#include <map>
#include <vector>

namespace synovia
{

/// grad u, element by element, at the nodes of the polynomials that it consists
/// of: the corners for order 1, and for order 2 on tetrahedra.
///
/// All points of an element at once, with inverse Jacobians that are kept: many
/// times as fast as by ElementTransformations. The apex of a pyramid is left
/// out, where there is no gradient.
class DisplacementGradient
{
public:
   /// Borrows both. @a displacement is in an H1 space with three components,
   /// ordered by node.
   DisplacementGradient(mfem::ParMesh &mesh,
                        const mfem::ParGridFunction &displacement);

   /// Evaluates what the members below give.
   void SetElement(int element);
   int Points() const { return current->rule.GetNPoints(); }
   /// d u_i / d x_j at the points, one after the other.
   const mfem::real_t *Component(int i, int j) const
   {
      return gradients.data() + (3 * i + j) * Points();
   }
   /// All components, 3 x 3, at one of the points.
   mfem::DenseMatrix At(int point) const;
   /// Places of the points, as meshed, 3 x points.
   mfem::DenseMatrix Places();
   int Attribute() const { return mesh.GetAttribute(current_element); }

private:
   struct Shapes
   {
      mfem::IntegrationRule rule;
      /// For each node: derivatives along each reference axis at the points.
      std::vector<mfem::real_t> derivatives;
   };
   static Shapes Tabulate(const mfem::FiniteElement &element);
   void KeepJacobians();

   mfem::ParMesh &mesh;
   const mfem::ParGridFunction &displacement;
   const mfem::Table &element_dofs;
   std::map<mfem::Geometry::Type, Shapes> shapes;
   /// Nine for each point, ordered as the gradients are, element by element,
   /// and where an element's begin.
   std::vector<mfem::real_t> inverse_jacobians;
   std::vector<size_t> begins;

   int current_element = 0;
   const Shapes *current = nullptr;
   /// For each component all points, along the reference axes and in space.
   std::vector<mfem::real_t> reference;
   std::vector<mfem::real_t> gradients;
};

} // namespace synovia
