#pragma once

#include "synovia/cases/case_file.hpp"
#include "synovia/feb/feb_input.hpp"
#include "synovia/materials/law_description.hpp"
#include "synovia/materials/tensor3.hpp"

#include <array>
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

/// The vector's components along r, theta and z of the frame.
Point3 InFrame(const Point3 &vector, const FrameCase &frame);

/// For each of the material's axes, in columns, which of the frame's axes r,
/// theta, z (0 to 2) is parallel to it. The import stops if one has none.
std::array<int, 3> FindAxes(const FebInput &from, const Tensor3<> &axes,
                            const FrameCase &frame);

} // namespace synovia
