#include "synovia/cases/case_codec.hpp"
#include "synovia/general/text.hpp"

#include <cmath>
#include <limits>

namespace synovia
{

using namespace mfem;

namespace
{
// Larger numbers are slips, and their products would overflow.
constexpr real_t largest_number = 1e30;

constexpr const char *free_word = "free";

const char *const curve_times = "times";
const char *const curve_values = "values";

template <typename List, typename Text>
std::string ListText(const List &list, Text text)
{
   std::string joined;
   for (const auto &item : list)
   {
      joined += (joined.empty() ? "" : ", ") + text(item);
   }
   return "[" + joined + "]";
}

std::string NumbersText(const std::vector<real_t> &numbers)
{
   return ListText(numbers, ShortestNumber);
}

std::string CurveText(const LoadCurve &curve)
{
   const std::vector<real_t> &times = curve.Corners();
   if (times.size() == 1)
   {
      return ShortestNumber(curve(times.front()));
   }
   std::vector<real_t> values;
   for (const real_t t : times)
   {
      values.push_back(curve(t));
   }
   return std::string("{") + curve_times + " = " + NumbersText(times) + ", " +
          curve_values + " = " + NumbersText(values) + "}";
}

std::string ItemPath(const std::string &path, size_t i)
{
   return path + "." + std::to_string(i);
}

bool IsNumber(const CaseValue &value)
{
   return value.type == CaseValue::Type::integer ||
          value.type == CaseValue::Type::number;
}

template <typename Integer>
void ReadInteger(const CaseValue &from, const std::string &path, Integer &value,
                 CaseReading &reading)
{
   if (from.type != CaseValue::Type::integer)
   {
      reading.Expect(path, TypeOf(value), from);
      return;
   }
   if (from.integer > std::numeric_limits<Integer>::max() ||
       from.integer < std::numeric_limits<Integer>::min())
   {
      reading.AddError(path, std::to_string(from.integer) +
                                " is too large for an integer here");
      return;
   }
   value = static_cast<Integer>(from.integer);
}

// Whether it is a list of this many; any number if size is 0.
bool IsList(const CaseValue &from, const std::string &path, size_t size,
            const std::string &expected, CaseReading &reading)
{
   if (from.type != CaseValue::Type::list ||
       (size > 0 && from.items.size() != size))
   {
      reading.Expect(path, expected, from);
      return false;
   }
   for (size_t i = 0; i < from.items.size(); i++)
   {
      reading.SetPlace(ItemPath(path, i), from.items[i].place);
   }
   return true;
}

// What is wrong with the points of a curve, and where.
void CheckCurve(const Numbers &times, const Numbers &values,
                const std::string &path, CaseReading &reading)
{
   if (times.empty() || times.size() != values.size())
   {
      reading.AddError(path, "the curve has " + std::to_string(times.size()) +
                                " times and " + std::to_string(values.size()) +
                                " values; give as many values as times, at "
                                "least one");
      return;
   }
   for (size_t i = 1; i < times.size(); i++)
   {
      if (times[i] <= times[i - 1])
      {
         reading.AddError(ItemPath(path + "." + curve_times, i),
                          "the times of a curve must ascend, but " +
                             ToText(times[i]) + " follows " +
                             ToText(times[i - 1]));
         return;
      }
   }
}

// One of the two lists of a curve.
Numbers ReadPoints(const CaseValue &curve, const std::string &key,
                   const std::string &path, CaseReading &reading)
{
   Numbers points;
   const CaseValue *from = curve.Find(key);
   const std::string here = path + "." + key;
   if (!from)
   {
      reading.AddError(path, "the curve has no \"" + key + "\"; write " +
                                CurveForms());
      return points;
   }
   reading.SetPlace(here, from->place);
   ReadValue(*from, here, points, reading);
   return points;
}

// A number or a curve; nothing, with a complaint, if it is neither.
std::optional<LoadCurve> ReadCurve(const CaseValue &from,
                                   const std::string &path,
                                   const std::string &expected,
                                   CaseReading &reading)
{
   if (IsNumber(from))
   {
      real_t constant = 0.0;
      ReadValue(from, path, constant, reading);
      return LoadCurve(constant);
   }
   if (from.type != CaseValue::Type::table)
   {
      reading.Expect(path, expected, from);
      return std::nullopt;
   }
   const size_t before = reading.Count();
   for (const CaseValue::Member &member : from.members)
   {
      if (member.key != curve_times && member.key != curve_values)
      {
         reading.SetPlace(path + "." + member.key, member.place);
         reading.AddError(path + "." + member.key,
                          "a curve has no such key; write " + CurveForms());
      }
   }
   const Numbers times = ReadPoints(from, curve_times, path, reading);
   const Numbers values = ReadPoints(from, curve_values, path, reading);
   if (reading.Count() == before)
   {
      CheckCurve(times, values, path, reading);
   }
   if (reading.Count() > before)
   {
      return std::nullopt;
   }
   return LoadCurve(times, values);
}
} // namespace

std::string CurveForms()
{
   return std::string("a number, or {") + curve_times + " = [...], " +
          curve_values + " = [...]}";
}

std::string TypeOf(const bool &)
{
   return "boolean";
}
std::string TypeOf(const int &)
{
   return "integer";
}
std::string TypeOf(const long long &)
{
   return "integer";
}
std::string TypeOf(const real_t &)
{
   return "number";
}
std::string TypeOf(const std::string &)
{
   return "string";
}
std::string TypeOf(const Names &)
{
   return "name or list of names";
}
std::string TypeOf(const Numbers &)
{
   return "list of numbers";
}
std::string TypeOf(const Numbers3 &)
{
   return "list of 3 numbers";
}
std::string TypeOf(const std::optional<LoadCurve> &)
{
   return "curve";
}
std::string TypeOf(const Components &)
{
   return "list of 3: curve or \"" + std::string(free_word) + "\"";
}
std::string TypeOf(const Curves &)
{
   return "list of 3 curves";
}
std::string TypeOf(const MeshGenerator &)
{
   return "list of strings";
}

TomlText TextOf(const bool &value)
{
   return value ? "true" : "false";
}
TomlText TextOf(const int &value)
{
   return std::to_string(value);
}
TomlText TextOf(const long long &value)
{
   return std::to_string(value);
}
TomlText TextOf(const real_t &value)
{
   return ShortestNumber(value);
}
TomlText TextOf(const std::string &value)
{
   return value.empty() ? TomlText() : Quoted(value);
}
TomlText TextOf(const Names &value)
{
   return value.empty() ? TomlText() : ListText(value, Quoted);
}
TomlText TextOf(const Numbers &value)
{
   return value.empty() ? TomlText() : NumbersText(value);
}
TomlText TextOf(const Numbers3 &value)
{
   return ListText(value, ShortestNumber);
}
TomlText TextOf(const std::optional<LoadCurve> &value)
{
   return value ? CurveText(*value) : TomlText();
}
TomlText TextOf(const Components &value)
{
   if (!value[0] && !value[1] && !value[2])
   {
      return TomlText();
   }
   return ListText(
      value, [](const std::optional<LoadCurve> &component)
      { return component ? CurveText(*component) : Quoted(free_word); });
}
TomlText TextOf(const Curves &value)
{
   return value ? ListText(*value, CurveText) : TomlText();
}
TomlText TextOf(const MeshGenerator &value)
{
   if (value.script.empty())
   {
      return TomlText();
   }
   std::vector<std::string> words{value.script};
   words.insert(words.end(), value.arguments.begin(), value.arguments.end());
   return ListText(words, Quoted);
}

void ReadValue(const CaseValue &from, const std::string &path, bool &value,
               CaseReading &reading)
{
   if (from.type != CaseValue::Type::boolean)
   {
      reading.Expect(path, "true or false", from);
      return;
   }
   value = from.boolean;
}

void ReadValue(const CaseValue &from, const std::string &path, int &value,
               CaseReading &reading)
{
   ReadInteger(from, path, value, reading);
}

void ReadValue(const CaseValue &from, const std::string &path, long long &value,
               CaseReading &reading)
{
   ReadInteger(from, path, value, reading);
}

void ReadValue(const CaseValue &from, const std::string &path, real_t &value,
               CaseReading &reading)
{
   if (!IsNumber(from))
   {
      reading.Expect(path, "a number", from);
   }
   else if (!std::isfinite(from.number) ||
            std::abs(from.number) > largest_number)
   {
      reading.AddError(path, "found " + ShortestNumber(from.number) +
                                "; numbers must be finite and at most " +
                                ToText(largest_number));
   }
   else
   {
      value = from.number;
   }
}

void ReadValue(const CaseValue &from, const std::string &path,
               std::string &value, CaseReading &reading)
{
   if (from.type != CaseValue::Type::text)
   {
      reading.Expect(path, "a string", from);
      return;
   }
   for (const char c : from.text)
   {
      if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f)
      {
         reading.AddError(path, "found " + from.Describe() +
                                   "; there must be no control characters");
         return;
      }
   }
   value = from.text;
}

void ReadValue(const CaseValue &from, const std::string &path, Names &value,
               CaseReading &reading)
{
   Names names(1);
   if (from.type == CaseValue::Type::text)
   {
      ReadValue(from, path, names.front(), reading);
   }
   else if (IsList(from, path, 0, "a name or a list of names", reading))
   {
      names.resize(from.items.size());
      for (size_t i = 0; i < names.size(); i++)
      {
         ReadValue(from.items[i], ItemPath(path, i), names[i], reading);
      }
   }
   else
   {
      return;
   }
   value = names;
}

void ReadValue(const CaseValue &from, const std::string &path, Numbers &value,
               CaseReading &reading)
{
   if (!IsList(from, path, 0, "a list of numbers", reading))
   {
      return;
   }
   value.assign(from.items.size(), 0.0);
   for (size_t i = 0; i < value.size(); i++)
   {
      ReadValue(from.items[i], ItemPath(path, i), value[i], reading);
   }
}

void ReadValue(const CaseValue &from, const std::string &path, Numbers3 &value,
               CaseReading &reading)
{
   if (!IsList(from, path, 3, "a list of 3 numbers", reading))
   {
      return;
   }
   for (size_t i = 0; i < 3; i++)
   {
      ReadValue(from.items[i], ItemPath(path, i), value[i], reading);
   }
}

void ReadValue(const CaseValue &from, const std::string &path,
               std::optional<LoadCurve> &value, CaseReading &reading)
{
   value = ReadCurve(from, path, CurveForms(), reading);
}

void ReadValue(const CaseValue &from, const std::string &path,
               Components &value, CaseReading &reading)
{
   const std::string each =
      CurveForms() + ", or \"" + std::string(free_word) + "\"";
   if (!IsList(from, path, 3, "a list of 3, each " + each, reading))
   {
      return;
   }
   for (size_t i = 0; i < 3; i++)
   {
      const CaseValue &item = from.items[i];
      value[i] = std::nullopt;
      if (item.type != CaseValue::Type::text || item.text != free_word)
      {
         value[i] = ReadCurve(item, ItemPath(path, i), each, reading);
      }
   }
}

void ReadValue(const CaseValue &from, const std::string &path, Curves &value,
               CaseReading &reading)
{
   if (!IsList(from, path, 3, "a list of 3, each " + CurveForms(), reading))
   {
      return;
   }
   std::array<LoadCurve, 3> curves{LoadCurve(0.0), LoadCurve(0.0),
                                   LoadCurve(0.0)};
   for (size_t i = 0; i < 3; i++)
   {
      const auto curve =
         ReadCurve(from.items[i], ItemPath(path, i), CurveForms(), reading);
      curves[i] = curve.value_or(LoadCurve(0.0));
   }
   value = curves;
}

void ReadValue(const CaseValue &from, const std::string &path,
               MeshGenerator &value, CaseReading &reading)
{
   const char *const expected =
      "a list of strings: the name of a script in meshes/ and its arguments, "
      "such as [\"boxes.py\", \"two_columns\"]";
   if (!IsList(from, path, 0, expected, reading))
   {
      return;
   }
   std::vector<std::string> words(from.items.size());
   for (size_t i = 0; i < words.size(); i++)
   {
      ReadValue(from.items[i], ItemPath(path, i), words[i], reading);
   }
   if (words.empty() ||
       (words.front().empty() && !reading.HasError(ItemPath(path, 0))))
   {
      reading.Expect(path, expected, from);
      return;
   }
   value.script = words.front();
   value.arguments.assign(words.begin() + 1, words.end());
}

} // namespace synovia
