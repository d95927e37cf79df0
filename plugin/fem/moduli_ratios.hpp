#pragma once

#include "synovia/fem/biphasic_spaces.hpp"
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
   /// The largest over the smallest stiffness of a stretch along one direction,
   /// of the axes of space and the diagonals between them: 1 for isotropic
   /// solids, about that of fibers and the matrix between them where fibers
   /// have one direction or two, and less than 3 where they are as stiff along
   /// three axes. Solids of finite deformation are looked at as meshed and
   /// stretched by a twentieth, as fibers that resist tension only are slack as
   /// meshed.
   mfem::real_t anisotropy = 0.0;
};

/// Looks at the centers of the elements, each of whose attributes must have a
/// material. Collective.
ModuliRatios FindModuliRatios(mfem::ParMesh &mesh,
                              const MaterialTable &materials);

/// The largest ModuliRatios::anisotropy of the elements around each
/// displacement true dof; 0 where all are rigid. Collective.
mfem::Vector FindAnisotropy(BiphasicSpaces &spaces,
                            const MaterialTable &materials);

} // namespace synovia
