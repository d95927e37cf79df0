#include "synovia/general/suggestion.hpp"

#include <algorithm>
#include <cctype>

namespace synovia
{

namespace
{

std::string Lower(std::string text)
{
   std::transform(text.begin(), text.end(), text.begin(),
                  [](unsigned char c) { return std::tolower(c); });
   return text;
}

// Edit distance in which a swap of neighbors counts once.
size_t EditDistance(const std::string &a, const std::string &b)
{
   const size_t n = b.size();
   std::vector<size_t> before(n + 1);
   std::vector<size_t> above(n + 1);
   std::vector<size_t> row(n + 1);
   for (size_t j = 0; j <= n; j++)
   {
      row[j] = j;
   }
   for (size_t i = 1; i <= a.size(); i++)
   {
      before = above;
      above = row;
      row[0] = i;
      for (size_t j = 1; j <= n; j++)
      {
         const size_t change = a[i - 1] == b[j - 1] ? 0 : 1;
         row[j] =
            std::min({above[j] + 1, row[j - 1] + 1, above[j - 1] + change});
         if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
         {
            row[j] = std::min(row[j], before[j - 2] + 1);
         }
      }
   }
   return row[n];
}

} // namespace

std::string Suggest(const std::string &name,
                    const std::vector<std::string> &candidates)
{
   const std::string lower = Lower(name);
   std::string best;
   // A third of the letters may be wrong, and two at most.
   size_t least = std::min<size_t>(2, lower.size() / 3) + 1;
   for (const std::string &candidate : candidates)
   {
      const size_t distance = EditDistance(lower, Lower(candidate));
      if (distance < least)
      {
         least = distance;
         best = candidate;
      }
   }
   return best;
}

} // namespace synovia
