// ranks: 1
//
// A key of a shipped case with another letter, at each place of each of them,
// is an error that names it with its line.

#include "support/shipped_cases.hpp"
#include "support/text_damage.hpp"
#include "synovia/cases/case_file.hpp"
#include "synovia/general/error.hpp"

#include <catch2/catch.hpp>

using namespace synovia;

namespace
{
constexpr const char *source = "case.toml";
} // namespace

TEST_CASE("A misspelt key is never overlooked", "[case]")
{
   std::vector<ShippedCase> cases = ShippedCases();
   int misspelt = 0;
   for (ShippedCase &shipped : cases)
   {
      const std::vector<std::string> lines =
         LinesOf(WithoutComments(shipped.text));
      for (size_t i = 0; i < lines.size(); i++)
      {
         const size_t end = lines[i].find(' ');
         if (end == std::string::npos || lines[i].find(" = ") != end)
         {
            continue;
         }
         // Another letter in the key, at each place of it.
         for (size_t k = 0; k < end; k++)
         {
            std::vector<std::string> changed(lines);
            changed[i][k] = 'q';
            const std::string key = changed[i].substr(0, end);
            CAPTURE(shipped.name, changed[i]);
            std::string said;
            try
            {
               ParseCase(JoinedLines(changed), source);
            }
            catch (const Error &error)
            {
               said = error.what();
            }
            CHECK(said.find(key + ": there is no such key") !=
                  std::string::npos);
            CHECK(said.find(source + std::string(":") + std::to_string(i + 1) +
                            ":1: ") != std::string::npos);
            misspelt++;
         }
      }
   }
   CHECK(misspelt > 500);
}
