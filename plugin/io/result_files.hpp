#pragma once

#include "mfem.hpp"

#include <string>

namespace synovia
{

// The files that a run writes into its output directory: history.*, lines/,
// logs/, fields/, checkpoint/, run.log and case.toml, with the report.html that
// is made of them. For one process. Errors are std::runtime_error.

/// The results in a directory, such as "history.csv, lines/ (3 files)"; empty
/// if there is none. A log, a case or a report without any is no result.
std::string ListResults(const std::string &directory);

/// Removes what runs and the report write, and directories that are empty then.
/// All else stays.
void RemoveResults(const std::string &directory);

/// Removes lines of times later than @a time, fields of steps later than
/// @a steps, from their time series, too, and the report.
void RemoveResultsAfter(const std::string &directory, mfem::real_t time,
                        int steps);

} // namespace synovia
