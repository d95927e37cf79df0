#include "synovia/cases/key_names.hpp"
#include "synovia/cases/case_value.hpp"
#include "synovia/general/suggestion.hpp"

namespace synovia
{

namespace
{
constexpr const char *bare_letters = "abcdefghijklmnopqrstuvwxyz"
                                     "ABCDEFGHIJKLMNOPQRSTUVWXYZ"
                                     "0123456789_-";
} // namespace

std::string Joined(const std::string &path, const std::string &key)
{
   const bool bare = key.find_first_not_of(bare_letters) == std::string::npos;
   return (path.empty() ? "" : path + ".") + (bare ? key : Quoted(key));
}

std::string EntryPath(const std::string &list, std::size_t i,
                      const std::string &key)
{
   const std::string entry = list + "." + std::to_string(i);
   return key.empty() ? entry : entry + "." + key;
}

std::string JoinedNames(const std::vector<std::string> &names)
{
   std::string text;
   for (const std::string &name : names)
   {
      text += (text.empty() ? "" : ", ") + name;
   }
   return text;
}

std::string DidYouMean(const std::string &name,
                       const std::vector<std::string> &known)
{
   const std::string guess = Suggest(name, known);
   return guess.empty() ? "" : "; did you mean \"" + guess + "\"?";
}

} // namespace synovia
