#pragma once

#include "synovia/feb/feb_input.hpp"
#include "synovia/materials/law_description.hpp"

#include <map>
#include <string>
#include <utility>
#include <vector>

namespace synovia
{

/// A law by its names, and its parameters by theirs: FEBio's first.
struct LawWords
{
   std::string feb;
   std::string law;
   std::vector<std::pair<std::string, std::string>> parameters;
};

/// The law that the attribute type of @a from names. Null, and the import
/// stops, if there is none; @a also names laws that are known besides.
const LawWords *FindLaw(const FebInput &from,
                        const std::vector<LawWords> &words,
                        const std::string &also);

/// The parameters of a law, by its own names. What is missing or out of range
/// stops the import.
std::map<std::string, mfem::real_t> ReadParameters(const FebInput &from,
                                                   const LawWords &words,
                                                   const LawDescription &law);

} // namespace synovia
