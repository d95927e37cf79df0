#include "synovia/cases/name_checks.hpp"
#include "synovia/cases/key_names.hpp"

namespace synovia
{

namespace
{
constexpr size_t longest_name = 100;
} // namespace

void Once::Enter(const std::string &name, const std::string &path,
                 const std::string &problem)
{
   const auto [first, fresh] = paths.emplace(name, path);
   reading.Require(fresh, path,
                   problem + " (" + WhereIs(reading.Places(), first->second) +
                      ")");
}

std::set<std::string> Distinct(const std::vector<std::string> &names)
{
   return std::set<std::string>(names.begin(), names.end());
}

void CheckNames(const std::vector<std::string> &names, const std::string &path,
                const std::string &kind, CaseReading &reading)
{
   reading.Require(!names.empty(), path,
                   "no " + kind + " is named; name at least one");
   std::set<std::string> seen;
   for (size_t i = 0; i < names.size(); i++)
   {
      reading.Require(!names[i].empty(), EntryPath(path, i),
                      "the name is empty");
      reading.Require(seen.insert(names[i]).second, EntryPath(path, i),
                      Quoted(names[i]) + " is named twice");
   }
}

void CheckFileName(const std::string &name, const std::string &path,
                   CaseReading &reading)
{
   reading.Require(name.find_first_of("/\\,\"'") == std::string::npos &&
                      name[0] != '.' && name.size() <= longest_name,
                   path,
                   "found the name " + Quoted(name) +
                      "; it must have at most " + std::to_string(longest_name) +
                      " letters, no slash, comma or quote, and no dot in "
                      "front");
}

} // namespace synovia
