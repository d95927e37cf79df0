#pragma once

#include "synovia/cases/case_file.hpp"

#include <algorithm>
#include <utility>
#include <vector>

namespace synovia
{

/// The words that a key allows, and what each stands for.
template <typename Enum>
using KeyWords = std::vector<std::pair<std::string, Enum>>;

/// The word for a value, and the value of a word, which must be among them.
template <typename Enum>
const std::string &WordFor(const Enum &value, const KeyWords<Enum> &words)
{
   return std::find_if(words.begin(), words.end(),
                       [&](const auto &entry) { return entry.second == value; })
      ->first;
}

template <typename Enum>
const Enum &ValueOf(const std::string &word, const KeyWords<Enum> &words)
{
   return std::find_if(words.begin(), words.end(),
                       [&](const auto &entry) { return entry.first == word; })
      ->second;
}

const KeyWords<TimeScheme> &TimeSchemeWords();
const KeyWords<LinearMethod> &LinearMethodWords();
const KeyWords<DirectLibrary> &DirectLibraryWords();
const KeyWords<Deformation> &DeformationWords();
const KeyWords<LogSubject> &LogSubjectWords();

std::string DeformationWord(Deformation deformation);

/// What a word of a case file, given to a program in another way, stands for.
/// Throws Error, which lists the words there are, if it is none of them.
TimeScheme TimeSchemeNamed(const std::string &word);
LinearMethod LinearMethodNamed(const std::string &word);

} // namespace synovia
