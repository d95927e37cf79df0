#pragma once

#include "mfem.hpp"

#include <limits>
#include <string>

namespace synovia
{

/// The numbers that an input may be; all of them unless said.
struct NumberRange
{
   mfem::real_t least = -std::numeric_limits<mfem::real_t>::infinity();
   mfem::real_t most = std::numeric_limits<mfem::real_t>::infinity();
   /// Whether the bounds themselves are left out.
   bool open = false;

   static NumberRange Positive();
   static NumberRange AtLeast(mfem::real_t least);
   static NumberRange Above(mfem::real_t least);
   /// Ends included.
   static NumberRange From(mfem::real_t least, mfem::real_t most);
   /// Ends left out.
   static NumberRange Inside(mfem::real_t least, mfem::real_t most);

   bool Has(mfem::real_t value) const;
   /// In words, after "must be"; empty for all numbers.
   std::string Text() const;
};

} // namespace synovia
