#pragma once

#include "synovia/cases/case_file.hpp"
#include "synovia/cases/key_table.hpp"

namespace synovia
{

/// All keys of a case file, bound to @a setup: the one place where they are
/// written.
KeyTable CaseKeys(CaseFile &setup);

} // namespace synovia
