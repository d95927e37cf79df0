#pragma once

#include <string>
#include <vector>

namespace synovia
{

std::vector<std::string> LinesOf(const std::string &text);
std::string JoinedLines(const std::vector<std::string> &lines);

/// What is not a comment: to damage that is not worth a run.
std::string WithoutComments(const std::string &text);

/// A case file as hands and disks damage it: numbers, letters, lines, marks and
/// bytes, in one to three places. The same for a seed on all platforms.
std::string DamagedText(const std::string &text, unsigned seed);

} // namespace synovia
