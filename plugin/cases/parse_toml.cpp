#include "cases/case_value.hpp"
#include "general/error.hpp"

#include <algorithm>
#include <stdexcept>

namespace synovia
{

namespace
{
/// What toml++ takes for impossible, which some damaged files get it to.
class TomlAssertion : public std::logic_error
{
public:
   using std::logic_error::logic_error;
};
} // namespace

[[noreturn]] static void FailTomlAssertion()
{
   throw TomlAssertion("toml++ lost its way");
}

} // namespace synovia

// In a release build toml++ would have the compiler build on its assertions,
// true or not.
#undef NDEBUG
#define TOML_ASSERT(expr)                                                      \
   do                                                                          \
   {                                                                           \
      if (!(expr))                                                             \
      {                                                                        \
         synovia::FailTomlAssertion();                                         \
      }                                                                        \
   } while (false)
#include <toml++/toml.h>

namespace synovia
{

namespace
{
CasePlace PlaceOf(const toml::source_region &region, const std::string &source)
{
   return {source, static_cast<int>(region.begin.line),
           static_cast<int>(region.begin.column)};
}

CaseValue Convert(const toml::node &node, const std::string &source)
{
   CaseValue value;
   value.place = PlaceOf(node.source(), source);
   if (const toml::table *table = node.as_table())
   {
      value.type = CaseValue::Type::table;
      for (const auto &[key, member] : *table)
      {
         value.members.push_back({std::string(key.str()),
                                  PlaceOf(key.source(), source),
                                  Convert(member, source)});
      }
   }
   else if (const toml::array *list = node.as_array())
   {
      value.type = CaseValue::Type::list;
      for (const toml::node &item : *list)
      {
         value.items.push_back(Convert(item, source));
      }
   }
   else if (const auto text = node.as_string())
   {
      value.type = CaseValue::Type::text;
      value.text = text->get();
   }
   else if (const auto integer = node.as_integer())
   {
      value.type = CaseValue::Type::integer;
      value.integer = integer->get();
      value.number = static_cast<double>(value.integer);
   }
   else if (const auto number = node.as_floating_point())
   {
      value.type = CaseValue::Type::number;
      value.number = number->get();
   }
   else if (const auto boolean = node.as_boolean())
   {
      value.type = CaseValue::Type::boolean;
      value.boolean = boolean->get();
   }
   else
   {
      value.type = CaseValue::Type::date;
   }
   return value;
}

// The line that got toml++ to fail an assertion: those tell no place.
int AssertingLine(const std::string &text)
{
   int line = 0;
   for (size_t end = 0; end < text.size();)
   {
      line++;
      end = std::min(text.find('\n', end), text.size() - 1) + 1;
      try
      {
         const toml::table fine = toml::parse(text.substr(0, end));
      }
      catch (const toml::parse_error &)
      {
         // A value that goes on in the next line, perhaps.
      }
      catch (const TomlAssertion &)
      {
         return line;
      }
   }
   return line;
}
} // namespace

CaseValue ParseToml(const std::string &text, const std::string &source)
{
   try
   {
      const toml::table table = toml::parse(text, source);
      return Convert(table, source);
   }
   catch (const toml::parse_error &error)
   {
      // Some of its texts are of several lines.
      std::string reason(error.description());
      std::replace(reason.begin(), reason.end(), '\n', ' ');
      throw Error(ToText(PlaceOf(error.source(), source)) +
                  ": this is not TOML: " + reason);
   }
   catch (const TomlAssertion &)
   {
      throw Error(ToText({source, AssertingLine(text), 1}) +
                  ": this is not TOML");
   }
}

} // namespace synovia
