#include "support/text_damage.hpp"

#include <algorithm>
#include <random>
#include <sstream>

namespace synovia
{

namespace
{
using Random = std::mt19937;

// The same on all platforms, unlike the standard distributions.
size_t Pick(Random &random, size_t count)
{
   return random() % count;
}

// Where words made of these letters begin and how long they are.
std::vector<std::pair<size_t, size_t>> Words(const std::string &text,
                                             const std::string &letters)
{
   std::vector<std::pair<size_t, size_t>> words;
   for (size_t at = text.find_first_of(letters); at != std::string::npos;
        at = text.find_first_of(letters, at))
   {
      const size_t end =
         std::min(text.find_first_not_of(letters, at), text.size());
      words.emplace_back(at, end - at);
      at = end;
   }
   return words;
}

const std::string digits = "0123456789.";
const std::string letters = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVW"
                            "XYZ_";

std::string ChangeNumber(std::string text, Random &random)
{
   static const std::vector<std::string> nonsense = {
      "nan",        "inf",
      "-inf",       "0",
      "-1",         "1e999",
      "1e300",      "-0.0",
      "1e-300",     "1e-30",
      "1e30",       "true",
      "\"1\"",      "[]",
      "{}",         "[1, 2]",
      "0x10",       "1_000",
      "1.5",        "3",
      "7",          "",
      "--1",        "1e",
      "1979-05-27", "9223372036854775808",
      "2147483648", "100000000",
      "\"auto\"",   "\"free\""};
   const auto numbers = Words(text, digits);
   const auto [at, size] = numbers[Pick(random, numbers.size())];
   return text.replace(at, size, nonsense[Pick(random, nonsense.size())]);
}

std::string Misspell(std::string text, Random &random)
{
   const auto words = Words(text, letters);
   const auto [at, size] = words[Pick(random, words.size())];
   const size_t letter = at + Pick(random, size);
   switch (Pick(random, 4))
   {
   case 0:
      return text.erase(letter, 1);
   case 1:
      return text.insert(letter, 1, letters[Pick(random, letters.size())]);
   case 2:
      text[letter] = letters[Pick(random, letters.size())];
      return text;
   default:
      std::swap(text[letter], text[at]);
      return text;
   }
}

std::string ChangeLines(const std::string &text, Random &random)
{
   std::vector<std::string> lines = LinesOf(text);
   const size_t i = Pick(random, lines.size());
   const size_t j = Pick(random, lines.size());
   switch (Pick(random, 4))
   {
   case 0:
      lines.erase(lines.begin() + i);
      break;
   case 1:
      lines.insert(lines.begin() + j, std::string(lines[i]));
      break;
   case 2:
      std::swap(lines[i], lines[j]);
      break;
   default:
      std::rotate(lines.begin() + std::min(i, j),
                  lines.begin() + std::max(i, j), lines.end());
   }
   return JoinedLines(lines);
}

std::string ChangeBytes(std::string text, Random &random)
{
   const size_t at = Pick(random, text.size());
   switch (Pick(random, 4))
   {
   case 0:
      text.resize(at);
      return text;
   case 1:
      text[at] = static_cast<char>(Pick(random, 256));
      return text;
   case 2:
      return text.erase(at, 1 + Pick(random, 30));
   default:
      for (size_t i = 0; i < 1 + Pick(random, 20); i++)
      {
         text.insert(at, 1, static_cast<char>(Pick(random, 256)));
      }
      return text;
   }
}

// Puts one thing of the text where another one was.
std::string Transplant(std::string text, Random &random)
{
   const std::string any = letters + digits + "\"";
   const auto words = Words(text, any);
   const auto [from, length] = words[Pick(random, words.size())];
   const std::string word = text.substr(from, length);
   const auto [to, size] = words[Pick(random, words.size())];
   return text.replace(to, size, word);
}

std::string Punctuate(std::string text, Random &random)
{
   const std::string marks = "[]{}=,\"'#.\n\\";
   const size_t at = Pick(random, text.size());
   return text.insert(at, 1, marks[Pick(random, marks.size())]);
}
} // namespace

std::vector<std::string> LinesOf(const std::string &text)
{
   std::vector<std::string> lines;
   std::istringstream stream(text);
   for (std::string line; std::getline(stream, line);)
   {
      lines.push_back(line);
   }
   return lines;
}

std::string JoinedLines(const std::vector<std::string> &lines)
{
   std::string text;
   for (const std::string &line : lines)
   {
      text += line + '\n';
   }
   return text;
}

std::string WithoutComments(const std::string &text)
{
   std::vector<std::string> lines;
   for (const std::string &line : LinesOf(text))
   {
      if (!line.empty() && line[0] != '#')
      {
         lines.push_back(line);
      }
   }
   return JoinedLines(lines);
}

std::string DamagedText(const std::string &text, unsigned seed)
{
   Random random(seed);
   std::string (*const ways[])(std::string, Random &) = {
      ChangeNumber, ChangeNumber, Misspell, ChangeBytes, Transplant, Punctuate};
   std::string mutant = text;
   const size_t times = 1 + Pick(random, 3);
   for (size_t i = 0; i < times && mutant.size() > 10; i++)
   {
      const size_t way = Pick(random, 7);
      mutant =
         way == 6 ? ChangeLines(mutant, random) : ways[way](mutant, random);
      if (Words(mutant, digits).empty() || Words(mutant, letters).empty())
      {
         break;
      }
   }
   return mutant;
}

} // namespace synovia
