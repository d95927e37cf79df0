#pragma once

#include "synovia/feb/feb_input.hpp"
#include "synovia/feb/feb_materials.hpp"

#include <set>
#include <string>
#include <vector>

namespace synovia
{

/// A plane of a rigid body that a surface keeps to and slides along: a contact
/// that bears tension.
struct FebGuide
{
   /// The pair of surfaces, which is none for other contact.
   std::string pair;
   /// Which slides, and its nodes by their places.
   std::string surface;
   std::set<int> nodes;
   /// Across the plane, of length 1.
   Point3 normal{};
   /// Place of the body among rigid materials.
   int body = 0;
};

/// Reads what contact of the file bears tension, and takes its pairs out of
/// those of the mesh. Stops the import where it is none along a plane.
std::vector<FebGuide> FindGuides(const FebInput &root, FebMesh &mesh,
                                 const FebMaterials &materials);

} // namespace synovia
