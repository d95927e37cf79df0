// ranks: 1
//
// Every key of a case file: a value of another type, one out of its range, and
// none where there must be one are errors that name it, and so are keys beside
// it that there are not. The keys are those that --dry-schema lists.

#include "synovia/cases/case_file.hpp"
#include "synovia/general/error.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <map>
#include <regex>
#include <set>
#include <sstream>

using namespace mfem;
using namespace synovia;

namespace
{
// One entry of each list.
const std::string text = R"([mesh]
file = "box.msh"
[[material]]
regions = "body"
solid = {E = 0.5, nu = 0.1}
permeability = {value = 4e-3}
[[boundary]]
name = "base"
surfaces = "z0"
pressure = 0
[[rigid_body]]
name = "plate"
surfaces = "z1"
[[ligament]]
name = "string"
from = {point = [0, 0, 0]}
to = {body = "plate", point = [0, 0, 2]}
stiffness = 1
[[joint]]
name = "hinge"
proximal = {body = "plate", origin = [0, 0, 0]}
distal = {origin = [0, 0, 0]}
[[contact]]
name = "pair"
source = "x0"
destination = "x1"
[[tie]]
name = "glue"
source = "y0"
destination = "y1"
[time]
step = 1
[[step]]
name = "press"
duration = 1
[[step.boundary]]
name = "base"
pressure = 1
[[step.rigid_body]]
name = "plate"
[[step.contact]]
name = "more"
source = "x2"
destination = "x3"
[[output.line]]
name = "axis"
from = [0, 0, 0]
to = [0, 0, 1]
[[output.log]]
file = "log.txt"
data = "ux"
)";

using Settings = std::vector<std::string>;

std::string Said(const Settings &settings)
{
   try
   {
      ParseCase(text, "case.toml", settings);
   }
   catch (const Error &error)
   {
      return error.what();
   }
   return "";
}

/// A key, and what has to be chosen for there to be one.
struct Key
{
   std::string path;
   std::string type;
   std::string range;
   bool required = false;
   Settings choices;

   std::string Table() const { return path.substr(0, path.rfind('.')); }
   std::string Name() const { return path.substr(path.rfind('.') + 1); }
};

std::string Trimmed(const std::string &part)
{
   return part.substr(0, part.find_last_not_of(' ') + 1);
}

bool StartsWith(const std::string &whole, const std::string &part)
{
   return whole.compare(0, part.size(), part) == 0;
}

/// What stands behind the last @a mark, which is taken off.
std::string TakeLast(std::string &meaning, const std::string &mark)
{
   const size_t at = meaning.rfind(mark);
   if (at == std::string::npos)
   {
      return "";
   }
   const std::string last = meaning.substr(at + mark.size());
   meaning.resize(at);
   return last;
}

std::vector<std::string> Words(const std::string &list)
{
   std::vector<std::string> words;
   size_t at = 0;
   while (at < list.size())
   {
      const size_t end = std::min(list.find(", ", at), list.size());
      words.push_back(list.substr(at, end - at));
      at = end + 2;
   }
   return words;
}

/// The keys of ListCaseKeys(), those of a word that chooses with each of the
/// words that they are for.
class Listing
{
public:
   Listing()
   {
      std::ostringstream out;
      ListCaseKeys(out);
      std::istringstream lines(out.str());
      std::string line;
      std::getline(lines, line);
      for (size_t i = 0; i < columns.size(); i++)
      {
         columns[i] = line.find(
            std::vector<std::string>{"type", "default", "unit", "meaning"}[i]);
      }
      while (std::getline(lines, line) && !line.empty())
      {
         Add(line);
      }
   }

   const std::vector<Key> &Keys() const { return keys; }
   /// With what has to be chosen for them to be there.
   const std::map<std::string, Settings> &Tables() const { return tables; }

private:
   std::string Column(const std::string &line, int i) const
   {
      return Trimmed(line.substr(columns[i], columns[i + 1] - columns[i]));
   }

   void Add(const std::string &line)
   {
      Key key;
      key.path = Trimmed(line.substr(0, columns[0]));
      // Entries of lists: the first.
      for (size_t at = key.path.find(".N"); at != std::string::npos;
           at = key.path.find(".N", at))
      {
         key.path.replace(at, 2, ".0");
      }
      key.type = Column(line, 0);
      key.required = Column(line, 1) == "required";
      std::string meaning = line.substr(columns[3]);
      if (std::find(choosers.begin(), choosers.end(), key.path) !=
          choosers.end())
      {
         return; // one of its words
      }
      std::vector<Key> all = Chosen(key, meaning);
      if (key.type == "word")
      {
         choosers.push_back(key.path);
      }
      static const std::regex range(
         "positive|(at least|above) [-+.e0-9]+|"
         "(from|between) [-+.e0-9]+ (to|and) [-+.e0-9]+");
      const std::string last = TakeLast(meaning, "; ");
      for (Key &one : all)
      {
         one.range = std::regex_match(last, range) ? last : "";
         tables.emplace(one.path.find('.') == std::string::npos ? ""
                                                                : one.Table(),
                        one.choices);
         keys.push_back(one);
      }
   }

   // The key with each choice of words; what says so is taken off the meaning,
   // where the outermost one is last.
   std::vector<Key> Chosen(const Key &key, std::string &meaning) const
   {
      std::vector<Key> all{key};
      for (const std::string &chooser : choosers)
      {
         const std::string table = chooser.substr(0, chooser.rfind('.') + 1);
         if (!StartsWith(key.path, table))
         {
            continue;
         }
         const std::vector<std::string> words =
            Words(TakeLast(meaning, "; for "));
         REQUIRE_FALSE(words.empty());
         std::vector<Key> more;
         for (const Key &one : all)
         {
            for (const std::string &word : words)
            {
               more.push_back(one);
               more.back().choices.push_back(chooser + "=\"" + word + '"');
            }
         }
         all = more;
      }
      return all;
   }

   std::array<size_t, 4> columns{};
   // Words that others depend on, from outside in, as they are listed; each
   // before those that it chooses.
   std::vector<std::string> choosers;
   std::vector<Key> keys;
   std::map<std::string, Settings> tables;
};

/// Whether one of the lines says something of the value at the path, or of a
/// part of it.
bool Names(const std::string &said, const std::string &path,
           const std::string &what)
{
   std::istringstream lines(said);
   for (std::string line; std::getline(lines, line);)
   {
      const size_t at = line.find(": " + path);
      if (at == std::string::npos)
      {
         continue;
      }
      const std::string rest = line.substr(at + 2 + path.size());
      if ((rest[0] == ':' || rest[0] == '.') &&
          rest.find(what) != std::string::npos)
      {
         return true;
      }
   }
   return false;
}

/// What no key of the type may be, as TOML.
std::vector<std::string> WrongValues(const std::string &type)
{
   // A date, which none is, and a table with a key that no curve has.
   std::vector<std::string> values{"1979-05-27", "{wrong = 1}",
                                   type == "boolean" ? "1" : "true"};
   const auto add = [&](std::initializer_list<const char *> more)
   { values.insert(values.end(), more.begin(), more.end()); };
   if (type == "string")
   {
      add({"1", "[\"a\"]", "\"a\\u0007\""});
   }
   else if (type == "boolean")
   {
      add({"\"true\"", "[true]"});
   }
   else if (type == "integer")
   {
      add({"1.5", "\"1\"", "[1]"});
   }
   else if (type == "number")
   {
      add({"\"1\"", "[1]", "nan", "-inf", "1e31"});
   }
   else if (type == "number or \"auto\"")
   {
      add({"\"Auto\"", "[1]", "nan", "0", "-1"});
   }
   else if (type == "list of 3 numbers")
   {
      add({"1", "[1, 2]", "[1, 2, 3, 4]", "[1, 2, \"3\"]", "[1, inf, 3]"});
   }
   else if (type == "name or list of names")
   {
      add({"1", "[1]", "[\"a\", [\"b\"]]"});
   }
   else if (type == "list of strings")
   {
      add({"\"a\"", "[\"a\", 1]", "[]"});
   }
   else if (type == "list of numbers")
   {
      add({"1", "[1, \"2\"]", "[1, nan]"});
   }
   else if (type == "list of integers")
   {
      add({"1", "[1, 1.5]"});
   }
   else if (type == "curve")
   {
      add({"\"free\"", "[1]", "inf", "{times = [0, 1], values = [0, true]}",
           "{times = [0, 1], values = [0]}"});
   }
   else if (type == "list of 3 curves")
   {
      add({"1", "[1, 2]", "[1, 2, \"free\"]", "[1, 2, {times = [0]}]"});
   }
   else if (type == "list of 3: curve or \"free\"")
   {
      add({"1", "[1, 2]", "[1, 2, \"fre\"]", "[1, 2, {times = [0]}]"});
   }
   else if (type == "list of tables")
   {
      add({"1", "[1]", "[[]]"});
   }
   else
   {
      // Words, which are listed.
      REQUIRE((type == "word" || type[0] == '"'));
      add({"1", "\"no such word\"", "[\"a\"]"});
   }
   return values;
}

/// Numbers just beyond a range, from its text.
std::vector<std::string> NumbersBeyond(const std::string &range, bool whole)
{
   std::istringstream words(range == "positive" ? "above 0" : range);
   std::string first;
   std::string word;
   real_t least = 0.0;
   real_t most = 0.0;
   words >> first;
   if (first == "at")
   {
      words >> word;
   }
   words >> least >> word >> most;
   std::vector<real_t> numbers;
   const bool open = first == "above" || first == "between";
   const real_t off = whole ? 1.0 : 1e-3 * std::max(std::abs(least), 1.0);
   numbers.push_back(least - off);
   if (open)
   {
      numbers.push_back(least);
   }
   if (first == "from" || first == "between")
   {
      numbers.push_back(whole ? most + 1.0 : 1.001 * most);
      if (open)
      {
         numbers.push_back(most);
      }
   }
   std::vector<std::string> texts;
   for (const real_t number : numbers)
   {
      std::ostringstream out;
      out.precision(15);
      out << number;
      texts.push_back(out.str());
   }
   return texts;
}

Settings With(Settings settings, const std::string &more)
{
   settings.push_back(more);
   return settings;
}

// Keys of solids count for the parts of a mixture as well.
std::vector<Key> OfParts(const std::vector<Key> &keys)
{
   const std::string solid = "material.0.solid.";
   const std::string part = solid + "solids.0.";
   std::vector<Key> parts;
   for (Key key : keys)
   {
      if (!StartsWith(key.path, solid) || key.Name() == "solids")
      {
         continue;
      }
      for (std::string &choice : key.choices)
      {
         choice.replace(0, solid.size(), part);
      }
      key.choices.insert(key.choices.begin(),
                         "material.0.solid={model=\"mixture\", solids=[{}]}");
      key.path.replace(0, solid.size(), part);
      parts.push_back(key);
   }
   return parts;
}

const std::vector<Key> &AllKeys()
{
   static const std::vector<Key> all = []()
   {
      std::vector<Key> keys = Listing().Keys();
      const std::vector<Key> parts = OfParts(keys);
      keys.insert(keys.end(), parts.begin(), parts.end());
      return keys;
   }();
   return all;
}
} // namespace

TEST_CASE("The case with an entry of each list is a good one", "[case]")
{
   CHECK(Said({}) == "");
   std::map<std::string, int> of_type;
   std::set<std::string> paths;
   for (const Key &key : AllKeys())
   {
      of_type[key.type]++;
      paths.insert(key.path);
   }
   CHECK(paths.size() > 300);
   CHECK(of_type["number"] > 100);
   CHECK(of_type["list of 3 numbers"] > 20);
   CHECK(of_type["curve"] > 10);
   // Some of those that depend on a word, or on two.
   for (const char *path :
        {"rigid_body.0.shape.normal", "rigid_body.0.shape.axis",
         "rigid_body.0.shape.hollow", "rigid_body.0.shape.scale",
         "material.0.solid.fibers.ksi", "material.0.permeability.k1_theta",
         "material.0.solid.solids.0.direction", "output.log.0.rigid_bodies",
         "step.0.rigid_body.0.relative", "joint.0.distal.flexion_axis",
         "tie.0.displacement_tolerance", "solver.tuning.contact.kept_slide"})
   {
      CAPTURE(path);
      CHECK(paths.count(path) == 1);
   }
}

TEST_CASE("A value of another type is an error that names the key", "[case]")
{
   for (const Key &key : AllKeys())
   {
      for (const std::string &value : WrongValues(key.type))
      {
         const std::string said =
            Said(With(key.choices, key.path + "=" + value));
         CAPTURE(key.choices, key.path, key.type, value, said);
         const bool curve = key.type.find("curve") != std::string::npos;
         CHECK((Names(said, key.path, "found ") ||
                (curve && Names(said, key.path, "curve "))));
      }
   }
}

TEST_CASE("A number out of its range is an error that names the key", "[case]")
{
   int ranges = 0;
   for (const Key &key : AllKeys())
   {
      if (key.range.empty())
      {
         continue;
      }
      ranges++;
      for (const std::string &number :
           NumbersBeyond(key.range, key.type == "integer"))
      {
         const std::string value =
            key.type == "list of 3 numbers" ? "[3, 3, " + number + "]" : number;
         const std::string said =
            Said(With(key.choices, key.path + "=" + value));
         CAPTURE(key.choices, key.path, key.range, value, said);
         CHECK(Names(said, key.path, "must be"));
      }
   }
   CHECK(ranges > 150);
}

TEST_CASE("A key that is missing is named", "[case]")
{
   int required = 0;
   for (const Key &key : AllKeys())
   {
      if (!key.required)
      {
         continue;
      }
      required++;
      // The table with the others that it must have; what they are counts
      // later.
      std::string table;
      std::set<std::string> names;
      Settings settings;
      for (const std::string &choice : key.choices)
      {
         const std::string path = choice.substr(0, choice.find('='));
         if (path.substr(0, path.rfind('.')) == key.Table())
         {
            table += path.substr(path.rfind('.') + 1) +
                     choice.substr(choice.find('=')) + ", ";
         }
         else
         {
            settings.push_back(choice);
         }
      }
      for (const Key &other : AllKeys())
      {
         if (other.required && other.Table() == key.Table() &&
             other.choices == key.choices && other.path != key.path &&
             names.insert(other.Name()).second)
         {
            table += other.Name() + " = 1, ";
         }
      }
      table = table.substr(0, table.rfind(','));
      // With steps the end follows from them.
      if (key.path == "time.end")
      {
         settings.push_back("step=[]");
      }
      settings.push_back(key.Table() + "={" + table + "}");
      const std::string said = Said(settings);
      CAPTURE(key.path, settings, said);
      CHECK(Names(said, key.path, "this is missing"));
   }
   CHECK(required > 100);
}

TEST_CASE("A key that there is not is named in every table", "[case]")
{
   const Listing listing;
   CHECK(listing.Tables().size() > 40);
   for (const auto &[table, choices] : listing.Tables())
   {
      const std::string path = table.empty() ? "nothing" : table + ".nothing";
      const std::string said = Said(With(choices, path + "=1"));
      CAPTURE(path, choices, said);
      CHECK(Names(said, path, "there is no such key"));
   }
}
