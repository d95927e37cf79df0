#pragma once

#include "mfem.hpp"

#include <algorithm>

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

} // namespace synovia
