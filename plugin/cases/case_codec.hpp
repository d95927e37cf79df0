#pragma once

#include "synovia/cases/case_file.hpp"
#include "synovia/general/load_curve.hpp"

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace synovia
{

using Components = std::array<std::optional<LoadCurve>, 3>;
using Curves = std::optional<std::array<LoadCurve, 3>>;
using Numbers3 = std::array<mfem::real_t, 3>;
using Place = std::optional<Numbers3>;
using Names = std::vector<std::string>;
using Numbers = std::vector<mfem::real_t>;
using Integers = std::vector<int>;

/// What a value of a case of each type is called, for users.
template <typename T>
inline constexpr const char *type_name = nullptr;
template <>
inline constexpr const char *type_name<bool> = "boolean";
template <>
inline constexpr const char *type_name<std::optional<bool>> = "boolean";
template <>
inline constexpr const char *type_name<int> = "integer";
template <>
inline constexpr const char *type_name<long long> = "integer";
template <>
inline constexpr const char *type_name<mfem::real_t> = "number";
template <>
inline constexpr const char *type_name<std::string> = "string";
template <>
inline constexpr const char *type_name<Names> = "name or list of names";
template <>
inline constexpr const char *type_name<Numbers> = "list of numbers";
template <>
inline constexpr const char *type_name<Integers> = "list of integers";
template <>
inline constexpr const char *type_name<Numbers3> = "list of 3 numbers";
template <>
inline constexpr const char *type_name<Place> = "list of 3 numbers";
template <>
inline constexpr const char *type_name<std::optional<LoadCurve>> = "curve";
template <>
inline constexpr const char *type_name<Components> =
   "list of 3: curve or \"free\"";
template <>
inline constexpr const char *type_name<Curves> = "list of 3 curves";
template <>
inline constexpr const char *type_name<MeshGenerator> = "list of strings";

/// A value as TOML; none if it isn't set.
using TomlText = std::optional<std::string>;

TomlText TextOf(const bool &value);
TomlText TextOf(const std::optional<bool> &value);
TomlText TextOf(const int &value);
TomlText TextOf(const long long &value);
TomlText TextOf(const mfem::real_t &value);
TomlText TextOf(const std::string &value);
TomlText TextOf(const Names &value);
TomlText TextOf(const Numbers &value);
TomlText TextOf(const Integers &value);
TomlText TextOf(const Numbers3 &value);
TomlText TextOf(const Place &value);
TomlText TextOf(const std::optional<LoadCurve> &value);
TomlText TextOf(const Components &value);
TomlText TextOf(const Curves &value);
TomlText TextOf(const MeshGenerator &value);

/// Reads a value; one of another type is an error, and the value stays.
void ReadValue(const CaseInput &from, bool &value);
void ReadValue(const CaseInput &from, std::optional<bool> &value);
void ReadValue(const CaseInput &from, int &value);
void ReadValue(const CaseInput &from, long long &value);
void ReadValue(const CaseInput &from, mfem::real_t &value);
void ReadValue(const CaseInput &from, std::string &value);
void ReadValue(const CaseInput &from, Names &value);
void ReadValue(const CaseInput &from, Numbers &value);
void ReadValue(const CaseInput &from, Integers &value);
void ReadValue(const CaseInput &from, Numbers3 &value);
void ReadValue(const CaseInput &from, Place &value);
void ReadValue(const CaseInput &from, std::optional<LoadCurve> &value);
void ReadValue(const CaseInput &from, Components &value);
void ReadValue(const CaseInput &from, Curves &value);
void ReadValue(const CaseInput &from, MeshGenerator &value);

/// The forms of a curve, for those who look up what "curve" means.
std::string CurveForms();

} // namespace synovia
