#include "synovia/cases/key_names.hpp"
#include "synovia/cases/key_table.hpp"

#include <algorithm>
#include <ostream>

namespace synovia
{

using namespace mfem;

bool KeyTable::Line::operator==(const Line &other) const
{
   return key == other.key && type == other.type &&
          standard == other.standard && unit == other.unit &&
          meaning == other.meaning;
}

void KeyTable::Collect(const std::string &path, std::vector<Line> &lines)
{
   for (CaseKey &key : keys)
   {
      const std::string here = Joined(path, key.name);
      std::string notes = key.meaning;
      const std::string range = key.range.Text();
      if (!range.empty())
      {
         notes += "; " + range;
      }
      if (key.value)
      {
         lines.push_back(
            {here, key.value->Type(),
             key.required ? "required" : key.value->Text().value_or("-"),
             key.unit.empty() ? "-" : key.unit, notes});
      }
      if (key.table)
      {
         key.table->Collect(here, lines);
      }
      if (key.list && key.list->sample)
      {
         key.list->sample([&](KeyTable &sample)
                          { sample.Collect(here + ".N", lines); });
      }
      else if (key.list)
      {
         lines.push_back({here, "list of tables",
                          key.required ? "required" : "-", "-", notes});
      }
   }
   if (chosen)
   {
      CollectChoice(path, lines);
   }
}

void KeyTable::CollectChoice(const std::string &path,
                             std::vector<Line> &lines) const
{
   // A key of several alternatives that means the same has one line.
   std::vector<Line> merged;
   std::vector<std::vector<std::string>> words;
   for (const Alternative &alternative : chosen->alternatives)
   {
      lines.push_back({Joined(path, chosen->key), Quoted(alternative.word), "-",
                       "-", alternative.meaning});
      std::vector<Line> own;
      chosen->describe(alternative.word).Collect(path, own);
      for (const Line &line : own)
      {
         const auto same = std::find(merged.begin(), merged.end(), line);
         if (same == merged.end())
         {
            merged.push_back(line);
            words.push_back({alternative.word});
         }
         else
         {
            words[same - merged.begin()].push_back(alternative.word);
         }
      }
   }
   for (size_t i = 0; i < merged.size(); i++)
   {
      merged[i].meaning += "; for " + JoinedNames(words[i]);
      lines.push_back(merged[i]);
   }
}

void KeyTable::List(std::ostream &out)
{
   std::vector<Line> lines{{"key", "type", "default", "unit", "meaning"}};
   Collect("", lines);
   std::string Line::*const columns[] = {&Line::key, &Line::type,
                                         &Line::standard, &Line::unit};
   for (const auto column : columns)
   {
      size_t width = 0;
      for (const Line &line : lines)
      {
         width = std::max(width, (line.*column).size());
      }
      for (Line &line : lines)
      {
         (line.*column).resize(width + 2, ' ');
      }
   }
   for (const Line &line : lines)
   {
      out << line.key << line.type << line.standard << line.unit << line.meaning
          << '\n';
   }
}

} // namespace synovia
