#pragma once

#include "synovia/contact/contact_options.hpp"
#include "synovia/materials/material_table.hpp"

namespace synovia
{

/// Which sides of a contact pair have fluid.
enum class FluidSides
{
   both,
   source,
   destination,
   none
};

/// Scales of a contact pair: given by its options, or derived from the bodies
/// behind its surfaces.
struct ContactScales
{
   FluidSides fluid = FluidSides::both;
   /// H_A of the softer side (stress).
   mfem::real_t softest_modulus = 0.0;
   /// kappa of the less permeable side (length^2 / stress / time); 0 if none
   /// has fluid.
   mfem::real_t least_permeability = 0.0;
   /// phi of FrictionLaw.
   mfem::real_t solid_fraction = 1.0;
   /// See ContactOptions (length).
   mfem::real_t gap_tolerance = 0.0;
   mfem::real_t overlap_limit = 0.0;
   mfem::real_t search_radius = 0.0;
};

/// Collective. Throws Error that names the @a pair if one of its surfaces has
/// no faces, or has fluid in some of its regions only, or if the destination is
/// rigid.
ContactScales FindContactScales(const std::string &pair, mfem::ParMesh &mesh,
                                const MaterialTable &materials,
                                const mfem::Array<int> &source_boundary,
                                const mfem::Array<int> &destination_boundary,
                                const ContactOptions &options);

} // namespace synovia
