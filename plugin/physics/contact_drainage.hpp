#pragma once

#include "synovia/contact/contact_pair.hpp"

#include <memory>
#include <vector>

namespace synovia
{

/// Finds the pressures at which surfaces of contact pairs drain freely: where
/// no pair seals them.
class ContactDrainage
{
public:
   /// Borrows spaces and pairs; @a sealed are attributes of boundaries that
   /// don't drain, but for their edges with others. Collective.
   ContactDrainage(BiphasicSpaces &spaces,
                   const std::vector<ContactPair *> &pairs,
                   const mfem::Array<int> &sealed);

   /// True dofs of the pressure that the pairs' active sets leave open,
   /// ascending. Collective.
   mfem::Array<int> OpenDofs() const;

private:
   BiphasicSpaces &spaces;
   const std::vector<ContactPair *> &pairs;
   /// Of the pairs' surfaces that drain where nothing touches.
   mfem::Array<int> dofs;
   /// From vertices to pressure dofs, where these are not the vertices; the
   /// matrix refers to the operator.
   std::unique_ptr<mfem::ParDiscreteLinearOperator> vertex_interpolation;
   std::unique_ptr<mfem::HypreParMatrix> vertices_to_pressure;
};

} // namespace synovia
