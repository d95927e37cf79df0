#include "synovia/cases/case_value.hpp"

#include <array>
#include <charconv>
#include <cstdio>

namespace synovia
{

namespace
{
// What is quoted of a long string.
constexpr size_t longest_quote = 40;

std::string Shortened(const std::string &text)
{
   return Quoted(text.size() <= longest_quote
                    ? text
                    : text.substr(0, longest_quote - 3) + "...");
}
} // namespace

std::string ToText(const CasePlace &place)
{
   std::string text = place.source;
   if (place.line > 0)
   {
      text +=
         ':' + std::to_string(place.line) + ':' + std::to_string(place.column);
   }
   return text;
}

CaseValue *CaseValue::Find(const std::string &key)
{
   for (Member &member : members)
   {
      if (member.key == key)
      {
         return &member.value;
      }
   }
   return nullptr;
}

const CaseValue *CaseValue::Find(const std::string &key) const
{
   return const_cast<CaseValue *>(this)->Find(key);
}

std::string CaseValue::Describe() const
{
   switch (type)
   {
   case Type::boolean:
      return boolean ? "true" : "false";
   case Type::integer:
      return "the integer " + std::to_string(integer);
   case Type::number:
      return "the number " + ShortestNumber(number);
   case Type::text:
      return "the string " + Shortened(text);
   case Type::date:
      return "a date or time";
   case Type::list:
      return items.empty() ? "an empty list"
                           : "a list of " + std::to_string(items.size());
   default:
      return "a table";
   }
}

std::string Quoted(const std::string &text)
{
   std::string quoted = "\"";
   for (const char c : text)
   {
      if (c == '"' || c == '\\')
      {
         quoted += '\\';
         quoted += c;
      }
      else if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f)
      {
         char code[8];
         std::snprintf(code, sizeof(code), "\\u%04X",
                       static_cast<unsigned char>(c));
         quoted += code;
      }
      else
      {
         quoted += c;
      }
   }
   return quoted + '"';
}

std::string ShortestNumber(double value)
{
   std::array<char, 40> digits;
   const std::to_chars_result end =
      std::to_chars(digits.data(), digits.data() + digits.size(), value);
   std::string text(digits.data(), end.ptr);
   // A whole number without a point would read back as an integer.
   if (text.find_first_not_of("-0123456789") == std::string::npos)
   {
      text += ".0";
   }
   return text;
}

} // namespace synovia
