#pragma once

#include "mfem.hpp"

#include <functional>

namespace synovia
{

/// Curves a mesh: continuous nodes of order @a order, or discontinuous ones.
///
/// @a positions_of(element, positions) gives the positions of the nodal points
/// of the element's finite element, one row of three for each. Returns the
/// first element which puts a node that it shares elsewhere than its
/// predecessor did, or -1 if all agree.
int SetElementNodes(
   mfem::Mesh &mesh, int order,
   const std::function<void(int, mfem::DenseMatrix &)> &positions_of,
   bool discontinuous = false);

} // namespace synovia
