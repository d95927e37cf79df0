#pragma once

#include "synovia/cases/case_file.hpp"

namespace synovia
{

/// The mesh of a case. Collective. Throws Error, with the place of the key, if
/// it can't be read, and says what makes it if it isn't there.
NamedMesh ReadCaseMesh(const CaseFile &setup, MPI_Comm comm);

} // namespace synovia
