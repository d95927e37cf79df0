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
constexpr const char *curve_times = "times";
constexpr const char *curve_values = "values";
constexpr const char *curve_repeat = "repeat";
constexpr int most_repeats = 10000;

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

std::string NumbersText(const Numbers &numbers)
{
   return ListText(numbers, ShortestNumber);
}

std::string CurveText(const LoadCurve &curve)
{
   const Numbers &times = curve.Corners();
   if (times.size() == 1)
   {
      return ShortestNumber(curve(times.front()));
   }
   Numbers values;
   for (const real_t t : times)
   {
      values.push_back(curve(t));
   }
   return std::string("{") + curve_times + " = " + NumbersText(times) + ", " +
          curve_values + " = " + NumbersText(values) + "}";
}

bool IsNumber(const CaseInput &from)
{
   return from.Is(CaseValue::Type::integer) || from.Is(CaseValue::Type::number);
}

template <typename Integer>
void ReadInteger(const CaseInput &from, Integer &value)
{
   if (!from.Is(CaseValue::Type::integer))
   {
      from.Expect(type_name<Integer>);
   }
   else if (from->integer > std::numeric_limits<Integer>::max() ||
            from->integer < std::numeric_limits<Integer>::min())
   {
      from.AddError(std::to_string(from->integer) +
                    " is too large for an integer here");
   }
   else
   {
      value = static_cast<Integer>(from->integer);
   }
}

// False, after an error, if it is no list.
template <typename Item>
bool ReadItems(const CaseInput &from, const std::string &expected,
               std::vector<Item> &items)
{
   if (!from.Is(CaseValue::Type::list))
   {
      from.Expect(expected);
      return false;
   }
   items.resize(from->items.size());
   for (size_t i = 0; i < items.size(); i++)
   {
      ReadValue(from.Item(i), items[i]);
   }
   return true;
}

// The same for a list of three, each read by @a read.
template <typename Read>
bool ReadThree(const CaseInput &from, const std::string &expected, Read read)
{
   if (!from.Is(CaseValue::Type::list) || from->items.size() != 3)
   {
      from.Expect("a list of 3" + expected);
      return false;
   }
   for (size_t i = 0; i < 3; i++)
   {
      read(from.Item(i), i);
   }
   return true;
}

// What is wrong with the points of a curve, and where.
void CheckCurve(const CaseInput &from, const Numbers &times,
                const Numbers &values, int repeat)
{
   if (times.empty() || times.size() != values.size())
   {
      from.AddError("the curve has " + std::to_string(times.size()) +
                    " times and " + std::to_string(values.size()) +
                    " values; give as many values as times, at least one");
      return;
   }
   for (size_t i = 1; i < times.size(); i++)
   {
      if (times[i] <= times[i - 1])
      {
         const CaseInput all =
            from.Member(curve_times, *from->Find(curve_times));
         all.Item(i).AddError("the times of a curve must ascend, but " +
                              ToText(times[i]) + " follows " +
                              ToText(times[i - 1]));
         return;
      }
   }
   if (repeat > 1 && (times.size() < 2 || values.front() != values.back()))
   {
      from.AddError("a curve that repeats must have two points at least, and "
                    "end with the value that it begins with");
   }
}

// One of the two lists of a curve.
Numbers ReadPoints(const CaseInput &curve, const std::string &key)
{
   Numbers points;
   if (const CaseValue *from = curve->Find(key))
   {
      ReadValue(curve.Member(key, *from), points);
   }
   else
   {
      curve.AddError("the curve has no \"" + key + "\"; write " + CurveForms());
   }
   return points;
}

// A number or a curve; nothing, after an error, if it is neither.
std::optional<LoadCurve> ReadCurve(const CaseInput &from,
                                   const std::string &expected)
{
   if (IsNumber(from))
   {
      real_t constant = 0.0;
      ReadValue(from, constant);
      return LoadCurve(constant);
   }
   if (!from.Is(CaseValue::Type::table))
   {
      from.Expect(expected);
      return std::nullopt;
   }
   const size_t before = from.Reading().Count();
   for (const CaseValue::Member &member : from->members)
   {
      if (member.key != curve_times && member.key != curve_values &&
          member.key != curve_repeat)
      {
         from.Member(member.key, member.value)
            .AddError("a curve has no such key; write " + CurveForms());
      }
   }
   const Numbers times = ReadPoints(from, curve_times);
   const Numbers values = ReadPoints(from, curve_values);
   int repeat = 1;
   if (const CaseValue *number = from->Find(curve_repeat))
   {
      const CaseInput input = from.Member(curve_repeat, *number);
      ReadValue(input, repeat);
      if (repeat < 1 || repeat > most_repeats)
      {
         input.AddError("a curve repeats from 1 to " +
                        std::to_string(most_repeats) + " times");
      }
   }
   if (from.Reading().Count() == before)
   {
      CheckCurve(from, times, values, repeat);
   }
   return from.Reading().Count() > before
             ? std::nullopt
             : std::make_optional(LoadCurve(times, values).Repeated(repeat));
}
} // namespace

std::string CurveForms()
{
   return std::string("a number, or {") + curve_times + " = [...], " +
          curve_values + " = [...]}";
}

TomlText TextOf(const bool &value)
{
   return value ? "true" : "false";
}
TomlText TextOf(const std::optional<bool> &value)
{
   return value ? TextOf(*value) : TomlText();
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
TomlText TextOf(const Integers &value)
{
   return value.empty() ? TomlText()
                        : ListText(value, [](int number)
                                   { return std::to_string(number); });
}
TomlText TextOf(const Numbers3 &value)
{
   return ListText(value, ShortestNumber);
}
TomlText TextOf(const Place &value)
{
   return value ? TextOf(*value) : TomlText();
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

void ReadValue(const CaseInput &from, bool &value)
{
   if (!from.Is(CaseValue::Type::boolean))
   {
      from.Expect("true or false");
      return;
   }
   value = from->boolean;
}

void ReadValue(const CaseInput &from, std::optional<bool> &value)
{
   bool given = false;
   ReadValue(from, given);
   if (!from.HasError())
   {
      value = given;
   }
}

void ReadValue(const CaseInput &from, int &value)
{
   ReadInteger(from, value);
}

void ReadValue(const CaseInput &from, long long &value)
{
   ReadInteger(from, value);
}

void ReadValue(const CaseInput &from, real_t &value)
{
   if (!IsNumber(from))
   {
      from.Expect("a number");
   }
   else if (!std::isfinite(from->number) ||
            std::abs(from->number) > largest_number)
   {
      from.AddError("found " + ShortestNumber(from->number) +
                    "; numbers must be finite and at most " +
                    ToText(largest_number));
   }
   else
   {
      value = from->number;
   }
}

void ReadValue(const CaseInput &from, std::string &value)
{
   if (!from.Is(CaseValue::Type::text))
   {
      from.Expect("a string");
      return;
   }
   for (const char c : from->text)
   {
      if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f)
      {
         from.AddError("found " + from->Describe() +
                       "; there must be no control characters");
         return;
      }
   }
   value = from->text;
}

void ReadValue(const CaseInput &from, Names &value)
{
   if (from.Is(CaseValue::Type::text))
   {
      value.resize(1);
      ReadValue(from, value.front());
   }
   else
   {
      ReadItems(from, "a name or a list of names", value);
   }
}

void ReadValue(const CaseInput &from, Numbers &value)
{
   ReadItems(from, "a list of numbers", value);
}

void ReadValue(const CaseInput &from, Integers &value)
{
   ReadItems(from, "a list of integers", value);
}

void ReadValue(const CaseInput &from, Numbers3 &value)
{
   ReadThree(from, " numbers",
             [&](const CaseInput &item, size_t i)
             { ReadValue(item, value[i]); });
}

void ReadValue(const CaseInput &from, Place &value)
{
   Numbers3 place{};
   if (ReadThree(from, " numbers",
                 [&](const CaseInput &item, size_t i)
                 { ReadValue(item, place[i]); }))
   {
      value = place;
   }
}

void ReadValue(const CaseInput &from, std::optional<LoadCurve> &value)
{
   value = ReadCurve(from, CurveForms());
}

void ReadValue(const CaseInput &from, Components &value)
{
   const std::string each = CurveForms() + ", or " + Quoted(free_word);
   ReadThree(from, ", each " + each,
             [&](const CaseInput &item, size_t i)
             {
                const bool is_free =
                   item.Is(CaseValue::Type::text) && item->text == free_word;
                value[i] = is_free ? std::nullopt : ReadCurve(item, each);
             });
}

void ReadValue(const CaseInput &from, Curves &value)
{
   std::array<LoadCurve, 3> curves{0.0, 0.0, 0.0};
   const auto read = [&](const CaseInput &item, size_t i)
   { curves[i] = ReadCurve(item, CurveForms()).value_or(0.0); };
   if (ReadThree(from, ", each " + CurveForms(), read))
   {
      value = curves;
   }
}

void ReadValue(const CaseInput &from, MeshGenerator &value)
{
   const char *const expected =
      "a list of strings: the name of a script in meshes/ and its arguments, "
      "such as [\"boxes.py\", \"two_columns\"]";
   Names words;
   if (!ReadItems(from, expected, words))
   {
      return;
   }
   if (words.empty() || (words.front().empty() && !from.Item(0).HasError()))
   {
      from.Expect(expected);
      return;
   }
   value.script = words.front();
   value.arguments.assign(words.begin() + 1, words.end());
}

} // namespace synovia
