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
   /// Without those of rigid bodies; without any others, the largest number.
   mfem::real_t SoftestModulus(const MaterialTable &materials) const;
   /// Whether any of them is part of a rigid body.
   bool IsRigid(const MaterialTable &materials) const;
   /// Of the regions with fluid; without any, the largest number.
   mfem::real_t LeastPermeability(const MaterialTable &materials) const;
   /// phi_s; 1 without fluid.
   mfem::real_t LargestSolidFraction(const MaterialTable &materials) const;
   /// How many of the regions have fluid.
   int WithFluid(const MaterialTable &materials) const;

   mfem::real_t area = 0.0;
   mfem::real_t volume = 0.0;
   /// Attributes of the regions, ascending.
   mfem::Array<int> regions;
};

} // namespace synovia
