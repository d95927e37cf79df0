#pragma once

#include "synovia/materials/material_table.hpp"

namespace synovia
{

/// (C eps(u), eps(w)) with the solid law of each element's attribute.
class EffectiveStressIntegrator : public mfem::BilinearFormIntegrator
{
public:
   /// Borrows @a materials.
   explicit EffectiveStressIntegrator(const MaterialTable &materials_)
      : materials(materials_)
   {
   }

   /// Where it evaluates the laws unless another rule is set.
   static const mfem::IntegrationRule &
   Rule(const mfem::FiniteElement &el,
        const mfem::ElementTransformation &trans);

   void AssembleElementMatrix(const mfem::FiniteElement &el,
                              mfem::ElementTransformation &trans,
                              mfem::DenseMatrix &elmat) override;

private:
   /// Adds the work of a point with the members' gradients and stiffness, which
   /// has the point's weight.
   void AddPoint(mfem::DenseMatrix &elmat) const;

   const MaterialTable &materials;
   /// Of the shape functions, dofs x 3, in the reference element and in space.
   mfem::DenseMatrix reference;
   mfem::DenseMatrix gradients;
   mfem::DenseMatrix stiffness;
};

} // namespace synovia
