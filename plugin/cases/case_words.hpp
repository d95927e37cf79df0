#pragma once

#include "synovia/cases/case_file.hpp"

#include <utility>
#include <vector>

namespace synovia
{

/// The words that a key allows, and what each stands for.
template <typename Enum>
using KeyWords = std::vector<std::pair<std::string, Enum>>;

const KeyWords<TimeScheme> &TimeSchemeWords();
const KeyWords<LinearMethod> &LinearMethodWords();
const KeyWords<DirectLibrary> &DirectLibraryWords();
const KeyWords<Deformation> &DeformationWords();

std::string DeformationWord(Deformation deformation);

/// What a word of a case file, given to a program in another way, stands for.
/// Throws Error, which lists the words there are, if it is none of them.
TimeScheme TimeSchemeNamed(const std::string &word);
LinearMethod LinearMethodNamed(const std::string &word);

} // namespace synovia
