#pragma once

#include "synovia/materials/element_frame.hpp"
#include "synovia/mesh/named_mesh.hpp"

namespace synovia
{

/// Theta is along a vector that the mesh file has for each element; r and z are
/// any directions perpendicular to it.
class FieldFrame : public ElementFrame
{
public:
   /// The vectors of this name have any length. Throws Error if there are none;
   /// elements without a vector are an error only where the frame is used.
   FieldFrame(const NamedMesh &mesh, const std::string &name);

   std::string Validate(mfem::ElementTransformation &trans) const override;

private:
   std::string name;
   /// Of the elements, in the file.
   std::vector<long long> numbers;
};

} // namespace synovia
