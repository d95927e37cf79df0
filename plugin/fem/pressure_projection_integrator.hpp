#pragma once

#include "synovia/materials/material_table.hpp"

namespace synovia
{

/// tau (p - Pi p, q - Pi q), Pi being the mean over the element and
/// tau = max(1/(2 mu), c/H_A) with c = 3 for hexahedra, 5 for prisms and 8 for
/// the others.
///
/// It makes equal order 1 stable in the undrained limit. The first bound is the
/// one of Stokes' equations (Bochev, Dohrmann & Gunzburger, SIAM J Numer Anal
/// 44, 2006; White & Borja, CMAME 197, 2008, for poromechanics); the second one
/// keeps the pressure from oscillating at drained boundaries in short steps,
/// where 1/(2 mu) is too little unless the drained solid is nearly
/// incompressible (Sun, Ostien & Salinger, Int J Numer Anal Methods Geomech 37,
/// 2013, have 3/H_A too). Synovia applies it to dp/dt, so that it is gone in
/// the steady state.
class PressureProjectionIntegrator : public mfem::BilinearFormIntegrator
{
public:
   /// Borrows @a materials. The matrix is multiplied by @a factor.
   explicit PressureProjectionIntegrator(const MaterialTable &materials_,
                                         mfem::real_t factor_ = 1.0)
      : materials(materials_), factor(factor_)
   {
   }

   void AssembleElementMatrix(const mfem::FiniteElement &el,
                              mfem::ElementTransformation &trans,
                              mfem::DenseMatrix &elmat) override;

private:
   const MaterialTable &materials;
   mfem::real_t factor;
   mfem::Vector shape;
   mfem::Vector integral;
};

} // namespace synovia
