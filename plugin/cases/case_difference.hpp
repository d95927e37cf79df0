#pragma once

#include "synovia/cases/case_file.hpp"

#include <string>
#include <vector>

namespace synovia
{

/// A key that two cases have with different values, as TOML has them; empty
/// where it is not set.
struct CaseChange
{
   std::string path;
   std::string before;
   std::string after;
};

/// The keys in which @a after differs from @a before, but for where the mesh
/// and the results are: they may have been moved.
std::vector<CaseChange> FindChanges(const CaseFile &before,
                                    const CaseFile &after);

/// Whether a run may be resumed with another value: title, time, solver and
/// output don't change the problem.
bool MayChange(const CaseChange &change);

/// "key: was A, is B", with the place of the key in front.
std::string ToText(const CaseChange &change, const CasePlaces &places = {});
/// A line each, indented; not too many.
std::string ToText(const std::vector<CaseChange> &changes,
                   const CasePlaces &places);

} // namespace synovia
