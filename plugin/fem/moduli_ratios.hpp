#pragma once

#include "synovia/materials/material_table.hpp"

namespace synovia
{

/// Ratios of the solids' moduli that make linear systems hard, the largest over
/// all elements.
struct ModuliRatios
{
   /// Aggregate modulus over shear modulus: how nearly incompressible the
   /// drained solid is.
   mfem::real_t incompressibility = 0.0;
   /// The largest stiffness along an axis of space over the aggregate modulus
   /// in the softest direction: 1 for isotropic solids, and at least a quarter
   /// of the ratio of the fibers' stiffness to the matrix' between them.
   mfem::real_t anisotropy = 0.0;
};

/// Looks at the centers of the elements, each of whose attributes must have a
/// material. Collective.
ModuliRatios FindModuliRatios(mfem::ParMesh &mesh,
                              const MaterialTable &materials);

} // namespace synovia
