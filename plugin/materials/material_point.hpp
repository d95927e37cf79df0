#pragma once

#include "mfem.hpp"

namespace synovia
{

/// A point of an undeformed body; borrows.
struct MaterialPoint
{
   /// Set to @a ip.
   mfem::ElementTransformation &trans;
   const mfem::IntegrationPoint &ip;
};

} // namespace synovia
