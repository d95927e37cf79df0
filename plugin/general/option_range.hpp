#pragma once

#include "mfem.hpp"

#include <string>

namespace synovia
{

/// Throw Error if what an option of the command line was given is out of its
/// range: with the option's name, the value, and what it may be. No option may
/// be infinite or no number.
void VerifyPositive(const std::string &option, mfem::real_t value);
void VerifyAtLeast(const std::string &option, mfem::real_t value,
                   mfem::real_t least);
/// Ends included.
void VerifyFrom(const std::string &option, mfem::real_t value,
                mfem::real_t least, mfem::real_t most);
/// Ends left out.
void VerifyBetween(const std::string &option, mfem::real_t value,
                   mfem::real_t low, mfem::real_t high);

} // namespace synovia
