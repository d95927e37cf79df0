#include "synovia/feb/feb_report.hpp"

#include <algorithm>
#include <ostream>

namespace synovia
{

namespace
{
// Further lines with the same entry are counted.
constexpr size_t most_lines = 3;
// A damaged file may have one in every line.
constexpr size_t most_entries = 1000;

std::string Lines(const std::vector<int> &lines)
{
   std::string text = lines.size() == 1 ? "line " : "lines ";
   for (size_t i = 0; i < std::min(lines.size(), most_lines); i++)
   {
      text += (i > 0 ? ", " : "") + std::to_string(lines[i]);
   }
   if (lines.size() > most_lines)
   {
      text += " and " + std::to_string(lines.size() - most_lines) + " more";
   }
   return text;
}
} // namespace

void FebReport::List(Fate fate, int line, const std::string &path,
                     const std::string &text)
{
   for (Entry &entry : entries)
   {
      if (entry.fate == fate && entry.path == path && entry.text == text)
      {
         entry.lines.push_back(line);
         return;
      }
   }
   if (entries.size() < most_entries)
   {
      entries.push_back({fate, path, text, {line}});
   }
}

void FebReport::ListUnread(const FebElement &root)
{
   ListUnread(root, "");
}

void FebReport::ListUnread(const FebElement &element, const std::string &path)
{
   const std::string here = path.empty() ? element.name : path;
   if (!IsRead(&element))
   {
      List(Fate::unsupported, element.line, here, "this is not known");
      return;
   }
   for (const FebAttribute &attribute : element.attributes)
   {
      if (!IsRead(&attribute))
      {
         List(Fate::unsupported, element.line, here,
              "the attribute " + attribute.name + "=\"" + attribute.value +
                 "\" is not known");
      }
   }
   for (const FebElement &child : element.children)
   {
      ListUnread(child, path.empty() ? child.name : path + "/" + child.name);
   }
}

bool FebReport::IsStopped() const
{
   return std::any_of(entries.begin(), entries.end(),
                      [](const Entry &entry)
                      { return entry.fate == Fate::unsupported; });
}

std::string FebReport::Text(Fate fate) const
{
   std::vector<Entry> sorted;
   for (const Entry &entry : entries)
   {
      if (entry.fate == fate)
      {
         sorted.push_back(entry);
      }
   }
   std::stable_sort(sorted.begin(), sorted.end(),
                    [](const Entry &a, const Entry &b)
                    { return a.lines[0] < b.lines[0]; });
   std::string text;
   for (const Entry &entry : sorted)
   {
      text += "  " + Lines(entry.lines) + ": " + entry.path + ": " +
              entry.text + "\n";
   }
   return text;
}

void FebReport::Print(const std::string &source, std::ostream &out) const
{
   const std::pair<Fate, const char *> headings[] = {
      {Fate::ignored, "ignored, without an effect on the result"},
      {Fate::approximated, "approximated"},
      {Fate::unsupported, "not supported, which stops the import"}};
   for (const auto &[fate, heading] : headings)
   {
      const std::string text = Text(fate);
      if (!text.empty())
      {
         out << source << ": " << heading << ":\n" << text;
      }
   }
   out << std::flush;
}

} // namespace synovia
