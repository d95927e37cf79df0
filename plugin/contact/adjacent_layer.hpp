#pragma once

#include "synovia/materials/material_table.hpp"

namespace synovia
{

/// The regions behind a surface, as a whole: what scales a contact pair.
class AdjacentLayer
{
public:
   /// Collective. Measures area and volume of the surface and of all elements
   /// that have the attribute of an element behind it.
   AdjacentLayer(mfem::ParMesh &mesh, const mfem::Array<int> &boundary);

   /// Mean thickness: volume over area.
   mfem::real_t Thickness() const { return volume / area; }
   mfem::real_t SoftestModulus(const MaterialTable &materials) const;
   mfem::real_t LeastPermeability(const MaterialTable &materials) const;

   mfem::real_t area = 0.0;
   mfem::real_t volume = 0.0;
   /// Attributes of the regions, ascending.
   mfem::Array<int> regions;
};

} // namespace synovia
