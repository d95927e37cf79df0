#pragma once

#include "synovia/cases/case_file.hpp"
#include "synovia/mesh/shape_mesh.hpp"

#include <optional>
#include <string>
#include <vector>

namespace synovia
{

/// A case file of miniapps/cases with a mesh of boxes that has its names.
struct ShippedCase
{
   std::string name;
   std::string text;
   NamedMesh mesh;
   /// The mesh without the shapes of rigid bodies, if the case has any.
   std::optional<NamedSerialMesh> bodies{};

   /// The mesh for what the text has become, with the shapes that it has now.
   /// Throws Error if they can't be made. Collective.
   NamedMesh &MeshFor(const CaseFile &setup);
};

/// All of them. Collective.
std::vector<ShippedCase> ShippedCases();

/// The names of the files, sorted.
std::vector<std::string> ShippedNames();

} // namespace synovia
