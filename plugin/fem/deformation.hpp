#pragma once

namespace synovia
{

/// The strains that bodies are made for.
enum class Deformation
{
   /// Linear laws, undeformed shape.
   infinitesimal,
   /// Laws of the deformation gradient, as HyperelasticLaw and
   /// DeformingPermeability; no contact yet.
   finite
};

} // namespace synovia
