#pragma once

#include "synovia/materials/material_table.hpp"

namespace synovia
{

/// (C eps(u), eps(w)) with the solid law of each element's attribute, and with
/// the mean dilatation of the element where the material says so (B-bar,
/// T. J. R. Hughes, Int. J. Numer. Methods Eng. 15:1413-1418, 1980).
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
   /// The same where strains have the mean dilatation, with the
   /// mean_gradients.
   void AddPointOfMeanDilatation(mfem::DenseMatrix &elmat) const;
   /// Sets the gradients at a point that @a trans is set to.
   void FindGradients(const mfem::DofToQuad &maps, int point,
                      mfem::ElementTransformation &trans);
   void FindMeanGradients(const mfem::DofToQuad &maps,
                          const mfem::IntegrationRule &rule,
                          mfem::ElementTransformation &trans);

   const MaterialTable &materials;
   /// Of the shape functions, dofs x 3, in the reference element and in space.
   mfem::DenseMatrix reference;
   mfem::DenseMatrix gradients;
   mfem::DenseMatrix mean_gradients;
   mfem::DenseMatrix stiffness;
};

} // namespace synovia
