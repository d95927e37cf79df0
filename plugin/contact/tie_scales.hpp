#pragma once

#include "synovia/contact/tie_options.hpp"
#include "synovia/materials/material_table.hpp"

namespace synovia
{

/// Scales of a tie: given by its options, or derived from the bodies behind its
/// surfaces.
struct TieScales
{
   /// Whether both sides have fluid, which passes from one to the other.
   bool exchanges = false;
   /// H_A of the softer side (stress).
   mfem::real_t softest_modulus = 0.0;
   /// kappa of the less permeable side (length^2 / stress / time); 0 if none
   /// passes.
   mfem::real_t least_permeability = 0.0;
   /// See TieOptions (length).
   mfem::real_t displacement_tolerance = 0.0;
   mfem::real_t search_radius = 0.0;
};

/// Collective. Throws Error that names the @a tie if one of its surfaces has no
/// faces, or has fluid in some of its regions only, or if one of them is rigid.
TieScales FindTieScales(const std::string &tie, mfem::ParMesh &mesh,
                        const MaterialTable &materials,
                        const mfem::Array<int> &source_boundary,
                        const mfem::Array<int> &destination_boundary,
                        const TieOptions &options);

} // namespace synovia
