#pragma once

#include "mfem.hpp"

#include <algorithm>
#include <limits>

namespace synovia
{

/// A quadrature's @a order, but on hexahedra and prisms no more Gauss points
/// along an edge than a box needs for products of two shape functions: what a
/// distorted element adds to the degree is no polynomial anyway.
inline int QuadratureOrder(const mfem::FiniteElement &el,
                           const mfem::ElementTransformation &trans, int order)
{
   return el.Space() == mfem::FunctionSpace::Qk
             ? std::min(order, 2 * std::max(el.GetOrder(), trans.Order()) + 1)
             : order;
}

/// The rule of WithFewerPoints, or none where it leaves MFEM's.
inline const mfem::IntegrationRule *
RuleOfFewerPoints(const mfem::FiniteElement &el,
                  const mfem::ElementTransformation &trans)
{
   constexpr int no_limit = std::numeric_limits<int>::max();
   return el.Space() == mfem::FunctionSpace::Qk
             ? &mfem::IntRules.Get(el.GetGeomType(),
                                   QuadratureOrder(el, trans, no_limit))
             : nullptr;
}

/// One of MFEM's integrators for H1 spaces, which takes more points than that.
/// On hexahedra the divergence of a displacement times a constant is exact all
/// the same, so that a uniform pressure deforms nothing.
template <typename Integrator>
class WithFewerPoints : public Integrator
{
public:
   using Integrator::Integrator;

   void AssembleElementMatrix(const mfem::FiniteElement &el,
                              mfem::ElementTransformation &trans,
                              mfem::DenseMatrix &elmat) override
   {
      SetRule(el, trans);
      Integrator::AssembleElementMatrix(el, trans, elmat);
   }

   void AssembleElementMatrix2(const mfem::FiniteElement &trial,
                               const mfem::FiniteElement &test,
                               mfem::ElementTransformation &trans,
                               mfem::DenseMatrix &elmat) override
   {
      SetRule(trial, trans);
      Integrator::AssembleElementMatrix2(trial, test, trans, elmat);
   }

private:
   void SetRule(const mfem::FiniteElement &el,
                const mfem::ElementTransformation &trans)
   {
      this->SetIntRule(RuleOfFewerPoints(el, trans));
   }
};

} // namespace synovia
