#include "synovia/general/shell_word.hpp"

namespace synovia
{

std::string ShellWord(const std::string &text)
{
   constexpr const char *plain = "abcdefghijklmnopqrstuvwxyz"
                                 "ABCDEFGHIJKLMNOPQRSTUVWXYZ"
                                 "0123456789_-+=:,./@%";
   if (!text.empty() && text.find_first_not_of(plain) == std::string::npos)
   {
      return text;
   }
   std::string word = "'";
   for (const char c : text)
   {
      word += c == '\'' ? "'\\''" : std::string(1, c);
   }
   return word + "'";
}

} // namespace synovia
