#pragma once

#include "synovia/fem/biphasic_spaces.hpp"
#include "synovia/general/point3.hpp"

#include <memory>

namespace synovia
{

/// Springs between a boundary and a fixed base, spread evenly over its area A:
///
///     sigma_T n = -k/A u, or, along a unit direction d alone, -k/A (d.u) d.
class SpringFoundation
{
public:
   /// Borrows @a spaces. @a boundary lists attributes; @a stiffness is the
   /// total of all springs, k (force / length), positive; @a direction has
   /// three components of any length, or none: then the springs act alike in
   /// all directions. Collective. Throws Error if the stiffness is not positive
   /// or the direction zero.
   SpringFoundation(BiphasicSpaces &spaces, const mfem::Array<int> &boundary,
                    mfem::real_t stiffness, const mfem::Vector &direction);

   /// Displacement x displacement (force / length), semi-definite.
   const mfem::HypreParMatrix &Matrix() const { return *matrix; }

   /// Force of the springs on the body at displacement @a u (true dofs).
   /// Collective.
   Point3 Force(const mfem::Vector &u) const;

private:
   std::unique_ptr<mfem::HypreParMatrix> matrix;
};

} // namespace synovia
