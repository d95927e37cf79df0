#pragma once

#include "materials/material_table.hpp"

namespace synovia
{

/// Strain-displacement matrix of small strain.
///
/// @param dshape  physical gradients of the shape functions, dofs x 3
/// @param strain  6 x (3 dofs): the Voigt strain xx, yy, zz, xy, yz, xz with
///                engineering shear of a displacement whose element dofs go
///                component by component, as MFEM's do
void CalcStrainMatrix(const mfem::DenseMatrix &dshape,
                      mfem::DenseMatrix &strain);

/// (C eps(u), eps(w)) with the solid law of each element's attribute.
class EffectiveStressIntegrator : public mfem::BilinearFormIntegrator
{
public:
   /// Borrows @a materials.
   explicit EffectiveStressIntegrator(const MaterialTable &materials_)
      : materials(materials_)
   {
   }

   void AssembleElementMatrix(const mfem::FiniteElement &el,
                              mfem::ElementTransformation &trans,
                              mfem::DenseMatrix &elmat) override;

private:
   const MaterialTable &materials;
   mfem::DenseMatrix dshape;
   mfem::DenseMatrix strain;
   mfem::DenseMatrix stiffness;
   mfem::DenseMatrix stress;
};

} // namespace synovia
