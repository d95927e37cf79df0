#pragma once

#include "synovia/contact/contact_factors.hpp"
#include "synovia/fem/rigid_surfaces.hpp"

#include <memory>
#include <vector>

namespace synovia
{

/// Terms of contact in the linearized equations, for displacements reduced by
/// RigidSurfaces where there are any.
class ReducedContact
{
public:
   /// Borrows both; @a rigid is null where nothing is driven.
   ReducedContact(const ContactTerms &original, const RigidSurfaces *rigid);

   /// The matrices have changed. Collective.
   void Update();

   const ContactTerms &Terms() const { return rigid ? reduced : original; }

private:
   using Matrix = mfem::HypreParMatrix;

   /// Keeps a matrix whose columns are displacements, or null, in reduced form.
   const Matrix *ReduceColumns(const Matrix *matrix);
   /// The same where rows are displacements, too.
   const Matrix *ReduceBoth(const Matrix *matrix);

   const ContactTerms &original;
   const RigidSurfaces *rigid;
   ContactTerms reduced;
   std::vector<std::unique_ptr<Matrix>> matrices;
};

} // namespace synovia
