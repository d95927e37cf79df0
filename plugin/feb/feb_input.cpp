#include "synovia/feb/feb_input.hpp"

#include <cerrno>
#include <cmath>
#include <cstdlib>

namespace synovia
{

using namespace mfem;

namespace
{
constexpr const char *separators = " ,\t\r\n";

std::vector<std::string> Split(const std::string &text)
{
   std::vector<std::string> words;
   size_t at = text.find_first_not_of(separators);
   while (at != std::string::npos)
   {
      const size_t end = text.find_first_of(separators, at);
      words.push_back(text.substr(at, end - at));
      at = text.find_first_not_of(separators, end);
   }
   return words;
}

bool ToNumber(const std::string &word, real_t &value)
{
   char *end = nullptr;
   value = std::strtod(word.c_str(), &end);
   return !word.empty() && *end == '\0' && std::isfinite(value);
}

bool ToInteger(const std::string &word, long long &value)
{
   char *end = nullptr;
   errno = 0;
   value = std::strtoll(word.c_str(), &end, 10);
   return !word.empty() && *end == '\0' && errno == 0 &&
          value >= -largest_feb_number && value <= largest_feb_number;
}
} // namespace

FebInput::FebInput(const FebElement &element_, const std::string &path_,
                   FebReport &report_)
   : element(element_), path(path_), report(report_)
{
   report.MarkRead(&element);
}

const std::string *FebInput::FindAttribute(const std::string &name) const
{
   for (const FebAttribute &attribute : element.attributes)
   {
      if (attribute.name == name)
      {
         report.MarkRead(&attribute);
         return &attribute.value;
      }
   }
   return nullptr;
}

std::string FebInput::Attribute(const std::string &name) const
{
   const std::string *value = FindAttribute(name);
   return value ? *value : "";
}

bool FebInput::HasAttribute(const std::string &name) const
{
   return FindAttribute(name) != nullptr;
}

std::string FebInput::NeededAttribute(const std::string &name) const
{
   const std::string value = Attribute(name);
   if (value.empty())
   {
      Stop("the attribute \"" + name + "\" is missing");
   }
   return value;
}

long long FebInput::NeededNumber(const std::string &name) const
{
   const std::string text = NeededAttribute(name);
   long long number = 0;
   if (!text.empty() && !ToInteger(text, number))
   {
      Stop("found " + name + "=\"" + text +
           "\"; it must be an integer of at most 15 digits");
      return 0;
   }
   return number;
}

FebInput FebInput::Child(const FebElement &child) const
{
   return {child, path.empty() ? child.name : path + "/" + child.name, report};
}

std::optional<FebInput> FebInput::Find(const std::string &name) const
{
   for (const FebElement &child : element.children)
   {
      if (child.name == name)
      {
         return Child(child);
      }
   }
   return std::nullopt;
}

std::vector<FebInput> FebInput::All(const std::string &name) const
{
   std::vector<FebInput> children;
   for (const FebElement &child : element.children)
   {
      if (child.name == name)
      {
         children.push_back(Child(child));
      }
   }
   return children;
}

std::vector<FebInput> FebInput::All() const
{
   std::vector<FebInput> children;
   for (const FebElement &child : element.children)
   {
      children.push_back(Child(child));
   }
   return children;
}

std::optional<real_t> FebInput::FindNumber() const
{
   real_t value = 0.0;
   if (!ToNumber(element.text, value))
   {
      Stop("found \"" + element.text + "\"; it must be a number");
      return std::nullopt;
   }
   return value;
}

std::vector<real_t> FebInput::Numbers() const
{
   std::vector<real_t> numbers;
   for (const std::string &word : Split(element.text))
   {
      numbers.push_back(0.0);
      if (!ToNumber(word, numbers.back()))
      {
         Stop("found \"" + word + "\" in a list of numbers");
         return {};
      }
   }
   return numbers;
}

std::vector<long long> FebInput::Integers() const
{
   std::vector<long long> integers;
   for (const std::string &word : Split(element.text))
   {
      integers.push_back(0);
      if (!ToInteger(word, integers.back()))
      {
         Stop("found \"" + word +
              "\" in a list of numbers of nodes or "
              "elements");
         return {};
      }
   }
   return integers;
}

real_t FebInput::Number(const std::string &child, real_t standard) const
{
   const std::optional<FebInput> found = Find(child);
   return found ? found->Number() : standard;
}

bool FebInput::Flag(const std::string &child, bool standard) const
{
   return Number(child, standard ? 1.0 : 0.0) != 0.0;
}

std::string FebInput::Word(const std::string &child,
                           const std::string &standard) const
{
   const std::optional<FebInput> found = Find(child);
   return found ? found->Text() : standard;
}

void FebInput::MarkAll(const FebElement &part) const
{
   report.MarkRead(&part);
   for (const FebAttribute &attribute : part.attributes)
   {
      report.MarkRead(&attribute);
   }
   for (const FebElement &child : part.children)
   {
      MarkAll(child);
   }
}

void FebInput::Ignore(const std::string &child, const std::string &why) const
{
   for (const FebInput &found : All(child))
   {
      found.IgnoreAll(why);
   }
}

void FebInput::IgnoreAll(const std::string &why) const
{
   MarkAll(element);
   report.List(FebReport::Fate::ignored, Line(), path, why);
}

void FebInput::Expect(const std::string &child, bool value,
                      const std::string &otherwise) const
{
   const std::optional<FebInput> found = Find(child);
   if (found && (found->Number() != 0.0) != value)
   {
      found->Stop(otherwise);
   }
}

void FebInput::Approximate(const std::string &how) const
{
   report.List(FebReport::Fate::approximated, Line(), path, how);
}

void FebInput::Stop(const std::string &why) const
{
   report.List(FebReport::Fate::unsupported, Line(), path, why);
}

void FebInput::StopAll(const std::string &why) const
{
   MarkAll(element);
   Stop(why);
}

} // namespace synovia
