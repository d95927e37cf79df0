#pragma once

#include "synovia/cases/case_file.hpp"
#include "synovia/general/load_curve.hpp"

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace synovia
{

// For each type that a value of a case can have: its name, its text as TOML
// (none if it isn't set), and how it is read. ReadValue() complains about a
// value of another type and leaves the present one.

using Components = std::array<std::optional<LoadCurve>, 3>;
using Curves = std::optional<std::array<LoadCurve, 3>>;
using Numbers3 = std::array<mfem::real_t, 3>;
using Names = std::vector<std::string>;
using Numbers = std::vector<mfem::real_t>;

std::string TypeOf(const bool &);
std::string TypeOf(const int &);
std::string TypeOf(const long long &);
std::string TypeOf(const mfem::real_t &);
std::string TypeOf(const std::string &);
std::string TypeOf(const Names &);
std::string TypeOf(const Numbers &);
std::string TypeOf(const Numbers3 &);
std::string TypeOf(const std::optional<LoadCurve> &);
std::string TypeOf(const Components &);
std::string TypeOf(const Curves &);
std::string TypeOf(const MeshGenerator &);

using TomlText = std::optional<std::string>;

TomlText TextOf(const bool &value);
TomlText TextOf(const int &value);
TomlText TextOf(const long long &value);
TomlText TextOf(const mfem::real_t &value);
TomlText TextOf(const std::string &value);
TomlText TextOf(const Names &value);
TomlText TextOf(const Numbers &value);
TomlText TextOf(const Numbers3 &value);
TomlText TextOf(const std::optional<LoadCurve> &value);
TomlText TextOf(const Components &value);
TomlText TextOf(const Curves &value);
TomlText TextOf(const MeshGenerator &value);

void ReadValue(const CaseValue &from, const std::string &path, bool &value,
               CaseReading &reading);
void ReadValue(const CaseValue &from, const std::string &path, int &value,
               CaseReading &reading);
void ReadValue(const CaseValue &from, const std::string &path, long long &value,
               CaseReading &reading);
void ReadValue(const CaseValue &from, const std::string &path,
               mfem::real_t &value, CaseReading &reading);
void ReadValue(const CaseValue &from, const std::string &path,
               std::string &value, CaseReading &reading);
void ReadValue(const CaseValue &from, const std::string &path, Names &value,
               CaseReading &reading);
void ReadValue(const CaseValue &from, const std::string &path, Numbers &value,
               CaseReading &reading);
void ReadValue(const CaseValue &from, const std::string &path, Numbers3 &value,
               CaseReading &reading);
void ReadValue(const CaseValue &from, const std::string &path,
               std::optional<LoadCurve> &value, CaseReading &reading);
void ReadValue(const CaseValue &from, const std::string &path,
               Components &value, CaseReading &reading);
void ReadValue(const CaseValue &from, const std::string &path, Curves &value,
               CaseReading &reading);
void ReadValue(const CaseValue &from, const std::string &path,
               MeshGenerator &value, CaseReading &reading);

/// The forms of a curve, for those who look up what "curve" means.
std::string CurveForms();

} // namespace synovia
