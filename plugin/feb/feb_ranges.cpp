#include "synovia/feb/feb_ranges.hpp"

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <sstream>

namespace synovia
{

namespace
{
// Longer lists are no lists of what a model has.
constexpr long long most_numbers = 10000000;

// A number, or a range FIRST:LAST or FIRST:LAST:STEP; false if it is neither.
bool AddRange(const std::string &word, std::vector<long long> &numbers)
{
   long long parts[3] = {0, 0, 1};
   int count = 0;
   const char *at = word.c_str();
   while (count < 3)
   {
      char *end = nullptr;
      errno = 0;
      parts[count++] = std::strtoll(at, &end, 10);
      if (end == at || errno != 0 || (*end != ':' && *end != '\0'))
      {
         return false;
      }
      if (*end == '\0')
      {
         at = end;
         break;
      }
      at = end + 1;
   }
   const long long last = count == 1 ? parts[0] : parts[1];
   if (*at != '\0' || parts[0] < 0 || last < parts[0] || parts[2] < 1 ||
       parts[2] > largest_feb_number || last > largest_feb_number ||
       last - parts[0] > most_numbers)
   {
      return false;
   }
   for (long long i = parts[0]; i <= last; i += parts[2])
   {
      numbers.push_back(i);
   }
   return true;
}
} // namespace

std::vector<long long> ReadRanges(const FebInput &from)
{
   std::string text = from.Text();
   std::replace(text.begin(), text.end(), ',', ' ');
   std::istringstream words(text);
   std::vector<long long> numbers;
   for (std::string word; words >> word;)
   {
      if (!AddRange(word, numbers))
      {
         from.Stop("found \"" + word + "\" in a list of numbers");
         return {};
      }
   }
   return numbers;
}

} // namespace synovia
