#include "synovia/cases/case_reading.hpp"
#include "synovia/cases/key_names.hpp"

#include <algorithm>
#include <tuple>

namespace synovia
{

namespace
{
constexpr size_t most_errors = 10;

CasePlace Nearest(const CasePlaces &places, std::string path)
{
   while (true)
   {
      const auto found = places.find(path);
      if (found != places.end())
      {
         return found->second;
      }
      if (path.empty())
      {
         return CasePlace();
      }
      const size_t dot = path.rfind('.');
      path.resize(dot == std::string::npos ? 0 : dot);
   }
}

std::string Prefixed(const CasePlace &place, const std::string &path)
{
   const std::string at = ToText(place);
   return at + (at.empty() || path.empty() ? "" : ": ") + path;
}
} // namespace

std::string WhereIs(const CasePlaces &places, const std::string &path)
{
   return Prefixed(Nearest(places, path), path);
}

void CaseReading::SetPlace(const std::string &path, const CasePlace &place)
{
   places[path] = place;
}

void CaseReading::AddError(const std::string &path, const std::string &problem)
{
   errors.push_back({Nearest(places, path), path, problem});
}

void CaseReading::Append(const CaseReading &other, const std::string &context)
{
   for (const CaseError &error : other.errors)
   {
      errors.push_back({error.place, error.path, context + error.problem});
   }
}

void CaseReading::Require(bool good, const std::string &path,
                          const std::string &problem)
{
   if (!good && !HasError(path))
   {
      AddError(path, problem);
   }
}

bool CaseReading::HasError(const std::string &path) const
{
   return std::any_of(errors.begin(), errors.end(),
                      [&](const CaseError &error)
                      { return error.path == path; });
}

void CaseReading::ThrowIfAny() const
{
   if (errors.empty())
   {
      return;
   }
   std::vector<CaseError> sorted(errors);
   std::stable_sort(sorted.begin(), sorted.end(),
                    [](const CaseError &a, const CaseError &b)
                    {
                       return std::tie(a.place.line, a.place.column) <
                              std::tie(b.place.line, b.place.column);
                    });
   std::string text;
   for (size_t i = 0; i < std::min(sorted.size(), most_errors); i++)
   {
      text += (i > 0 ? "\n  " : "") +
              Prefixed(sorted[i].place, sorted[i].path) + ": " +
              sorted[i].problem;
   }
   if (sorted.size() > most_errors)
   {
      text +=
         "\n  and " + std::to_string(sorted.size() - most_errors) + " more";
   }
   throw Error(text);
}

CaseInput::CaseInput(const CaseValue &value_, const std::string &path_,
                     CaseReading &reading_)
   : value(value_), path(path_), reading(reading_)
{
}

CaseInput CaseInput::Item(size_t i) const
{
   return Member(std::to_string(i), value.items[i]);
}

CaseInput CaseInput::Member(const std::string &key,
                            const CaseValue &member) const
{
   const std::string here = Joined(path, key);
   reading.SetPlace(here, member.place);
   return CaseInput(member, here, reading);
}

void CaseInput::AddError(const std::string &problem) const
{
   reading.AddError(path, problem);
}

void CaseInput::Expect(const std::string &expected) const
{
   AddError("found " + value.Describe() + "; expected " + expected);
}

} // namespace synovia
