#include "synovia/mesh/msh_cursor.hpp"
#include "synovia/general/error.hpp"

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <limits>

namespace synovia
{

namespace
{

bool IsBlank(char c)
{
   return std::isspace(static_cast<unsigned char>(c));
}

} // namespace

MshCursor::MshCursor(std::string text_) : text(std::move(text_)) {}

void MshCursor::Fail(const std::string &what) const
{
   const auto here = text.begin() + std::min(at, text.size());
   const auto line = 1 + std::count(text.begin(), here, '\n');
   throw Error(what + (binary ? " (byte " + std::to_string(at) + ")"
                              : " (line " + std::to_string(line) + ")"));
}

void MshCursor::CutOff() const
{
   Fail("the file is cut off");
}

std::string MshCursor::Line()
{
   const size_t end = text.find('\n', at);
   if (end == std::string::npos)
   {
      CutOff();
   }
   std::string line = text.substr(at, end - at);
   at = end + 1;
   if (!line.empty() && line.back() == '\r')
   {
      line.pop_back();
   }
   return line;
}

bool MshCursor::NextSection(std::string &name)
{
   SkipBlanks();
   if (at == text.size())
   {
      return false;
   }
   if (text[at] != '$')
   {
      Fail("expected a section, such as $Nodes" + Found());
   }
   name = Line().substr(1);
   name.erase(name.find_last_not_of(" \t") + 1);
   return true;
}

void MshCursor::EndSection(const std::string &name)
{
   SkipBlanks();
   if (at == text.size())
   {
      CutOff();
   }
   const std::string end = "$End" + name;
   if (text.compare(at, end.size(), end) != 0)
   {
      Fail("expected " + end + Found());
   }
   at = std::min(text.size(), text.find('\n', at));
}

void MshCursor::SkipSection(const std::string &name)
{
   at = std::min(text.size(), text.find("$End" + name, at));
   EndSection(name);
}

int MshCursor::Int()
{
   if (binary)
   {
      return Bytes<std::int32_t>();
   }
   const auto parse = [](const char *from, char **end)
   { return std::strtoll(from, end, 10); };
   const long long value = Number<long long>(parse);
   if (value < std::numeric_limits<int>::min() ||
       value > std::numeric_limits<int>::max())
   {
      Fail("the number " + std::to_string(value) + " is too large");
   }
   return static_cast<int>(value);
}

size_t MshCursor::Count()
{
   if (binary)
   {
      return Bytes<std::uint64_t>();
   }
   const auto parse = [](const char *from, char **end)
   { return std::strtoll(from, end, 10); };
   const long long value = Number<long long>(parse);
   if (value < 0)
   {
      Fail("expected a number from 0 on, found " + std::to_string(value));
   }
   return value;
}

double MshCursor::Real()
{
   const auto parse = [](const char *from, char **end)
   { return std::strtod(from, end); };
   return binary ? Bytes<double>() : Number<double>(parse);
}

void MshCursor::SkipInts(size_t number, size_t each)
{
   Skip(number, each, sizeof(std::int32_t), [this]() { Int(); });
}

void MshCursor::SkipCounts(size_t number, size_t each)
{
   Skip(number, each, sizeof(std::uint64_t), [this]() { Count(); });
}

void MshCursor::SkipReals(size_t number, size_t each)
{
   Skip(number, each, sizeof(double), [this]() { Real(); });
}

std::string MshCursor::Found() const
{
   if (binary)
   {
      return "";
   }
   const std::string word = text.substr(at, 20);
   return ", found \"" + word.substr(0, word.find_first_of(" \t\r\n")) + "\"";
}

void MshCursor::SkipBlanks()
{
   while (at < text.size() && IsBlank(text[at]))
   {
      at++;
   }
}

template <typename Read>
void MshCursor::Skip(size_t number, size_t each, size_t bytes, Read read)
{
   if (binary)
   {
      // A damaged number may be large enough for a product to overflow.
      if (number > (text.size() - at) / (each * bytes))
      {
         CutOff();
      }
      at += number * each * bytes;
      return;
   }
   for (size_t i = 0; i < number; i++)
   {
      for (size_t j = 0; j < each; j++)
      {
         read();
      }
   }
}

template <typename T>
T MshCursor::Bytes()
{
   if (text.size() - at < sizeof(T))
   {
      CutOff();
   }
   T value;
   std::memcpy(&value, text.data() + at, sizeof(T));
   at += sizeof(T);
   return value;
}

template <typename T, typename Parse>
T MshCursor::Number(Parse parse)
{
   SkipBlanks();
   if (at == text.size())
   {
      CutOff();
   }
   const char *const from = text.c_str() + at;
   char *end = nullptr;
   const T value = parse(from, &end);
   if (end == from || (*end != '\0' && !IsBlank(*end)))
   {
      Fail("expected a number" + Found());
   }
   at += end - from;
   return value;
}

} // namespace synovia
