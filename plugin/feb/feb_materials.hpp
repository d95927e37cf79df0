#pragma once

#include "synovia/cases/case_file.hpp"
#include "synovia/feb/feb_element_data.hpp"

#include <set>

namespace synovia
{

/// A rigid body of a model.
struct FebRigidMaterial
{
   /// Number and name: either may stand for it.
   std::string number;
   std::string name;
   /// For messages.
   FebInput where;
   Point3 center{{0.0, 0.0, 0.0}};
   mfem::real_t density = 1.0;
   /// Places of the parts that are of it.
   std::set<int> parts{};

   bool IsCalled(const std::string &word) const
   {
      return word == number || word == name;
   }
};

/// What parts are made of.
struct FebMaterials
{
   std::vector<MaterialCase> materials;
   std::vector<FebRigidMaterial> rigid;
   /// Places of the parts that deform.
   std::set<int> deformable;
   /// Directions of elements by their names, which frames refer to.
   std::map<std::string, FebElementData::Vectors> fields;
};

/// Reads the section Material, for the parts of the mesh.
FebMaterials ReadMaterials(const FebInput &section, const FebMesh &mesh,
                           const FebElementData &data);

} // namespace synovia
