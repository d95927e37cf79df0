#include "synovia/cases/case_difference.hpp"
#include "synovia/cases/case_keys.hpp"

#include <algorithm>
#include <map>
#include <regex>

namespace synovia
{

namespace
{
constexpr std::size_t most_changes = 10;

using Values = std::vector<std::pair<std::string, std::string>>;

/// The keys with their values, in order.
Values ValuesOf(const CaseFile &setup)
{
   CaseFile copy(setup);
   copy.mesh.file.clear();
   for (RigidBodyCase &body : copy.rigid_bodies)
   {
      body.shape.file.clear();
   }
   copy.output.directory.clear();
   Values values;
   CaseKeys(copy).Values("", values);
   return values;
}

bool IsBelow(const std::string &path, const std::string &table)
{
   return path == table || path.rfind(table + ".", 0) == 0;
}

std::string ValueText(const std::string &value)
{
   return value.empty() ? "not set" : value;
}
} // namespace

std::vector<CaseChange> FindChanges(const CaseFile &before,
                                    const CaseFile &after)
{
   const Values new_values = ValuesOf(after);
   std::map<std::string, std::string> remaining(new_values.begin(),
                                                new_values.end());
   std::vector<CaseChange> changes;
   for (const auto &[path, value] : ValuesOf(before))
   {
      const std::string now = remaining[path];
      remaining.erase(path);
      if (now != value)
      {
         changes.push_back({path, value, now});
      }
   }
   for (const auto &[path, value] : new_values)
   {
      if (remaining.count(path) > 0)
      {
         changes.push_back({path, "", value});
      }
   }
   return changes;
}

bool MayChange(const CaseChange &change)
{
   static const std::regex step_times(
      R"(step\.[0-9]+\.(step|growth|adaptive|min_step|max_step))");
   return IsBelow(change.path, "title") || IsBelow(change.path, "time") ||
          std::regex_match(change.path, step_times) ||
          IsBelow(change.path, "mesh.generator") ||
          IsBelow(change.path, "solver") || IsBelow(change.path, "output");
}

std::string ToText(const CaseChange &change, const CasePlaces &places)
{
   return WhereIs(places, change.path) + ": was " + ValueText(change.before) +
          ", is " + ValueText(change.after);
}

std::string ToText(const std::vector<CaseChange> &changes,
                   const CasePlaces &places)
{
   std::string text;
   for (std::size_t i = 0; i < std::min(changes.size(), most_changes); i++)
   {
      text += (i > 0 ? "\n  " : "  ") + ToText(changes[i], places);
   }
   if (changes.size() > most_changes)
   {
      text += "\n  and " + std::to_string(changes.size() - most_changes) +
              " more keys";
   }
   return text;
}

} // namespace synovia
