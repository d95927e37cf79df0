#pragma once

#include "synovia/fem/biphasic_spaces.hpp"
#include "synovia/materials/deformation.hpp"
#include "synovia/materials/material_table.hpp"
#include "synovia/mesh/named_mesh.hpp"

namespace synovia
{

/// Throws Error on all ranks if a law can't be used where it will be evaluated:
/// if it objects to an element, if its moduli or its typical permeability are
/// not positive and finite, or if at a quadrature point of the assembly its
/// permeability is not positive and finite or its stiffness not finite,
/// symmetric and positive definite. Infinitesimal deformation takes isotropic
/// permeabilities only.
///
/// Of several elements the text names the first in the mesh before
/// distribution. Collective.
void VerifyLaws(NamedMesh &mesh, BiphasicSpaces &spaces,
                const MaterialTable &materials, Deformation deformation);

} // namespace synovia
