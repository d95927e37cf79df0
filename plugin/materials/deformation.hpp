#pragma once

namespace synovia
{

/// The deformation that bodies are modeled for.
enum class Deformation
{
   /// Small displacements and strains: linear solids, undeformed shape.
   infinitesimal,
   /// Of any size: solids and permeabilities that follow the deformation
   /// gradient.
   finite
};

} // namespace synovia
