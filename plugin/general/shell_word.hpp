#pragma once

#include <string>

namespace synovia
{

/// The text as one word of a shell's command line, in quotes where it needs
/// them.
std::string ShellWord(const std::string &text);

} // namespace synovia
