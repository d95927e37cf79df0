#include "synovia/cases/key_table.hpp"
#include "synovia/general/suggestion.hpp"
#include "synovia/general/text.hpp"

#include <algorithm>
#include <iomanip>
#include <ostream>

namespace synovia
{

using namespace mfem;

namespace
{
constexpr const char *auto_word = "auto";

constexpr const char *bare_letters = "abcdefghijklmnopqrstuvwxyz"
                                     "ABCDEFGHIJKLMNOPQRSTUVWXYZ"
                                     "0123456789_-";

std::string Joined(const std::string &path, const std::string &key)
{
   const bool bare = key.find_first_not_of(bare_letters) == std::string::npos;
   return (path.empty() ? "" : path + ".") + (bare ? key : Quoted(key));
}

std::string JoinedNames(const std::vector<std::string> &names)
{
   std::string text;
   for (const std::string &name : names)
   {
      text += (text.empty() ? "" : ", ") + name;
   }
   return text;
}

std::string DidYouMean(const std::string &name,
                       const std::vector<std::string> &known)
{
   const std::string guess = Suggest(name, known);
   return guess.empty() ? "" : "; did you mean \"" + guess + "\"?";
}

/// A number, or the word for one that is derived.
class AutoBinding : public KeyBinding
{
public:
   explicit AutoBinding(real_t &value_) : value(value_) {}
   std::string Type() const override
   {
      return std::string("number or \"") + auto_word + "\"";
   }
   TomlText Text() const override
   {
      return value == 0.0 ? Quoted(auto_word) : ShortestNumber(value);
   }
   void Read(const CaseValue &from, const std::string &path,
             CaseReading &reading) override
   {
      if (from.type == CaseValue::Type::text)
      {
         if (ReadWord(from, path, {auto_word}, reading) == 0)
         {
            value = 0.0;
         }
         return;
      }
      ReadValue(from, path, value, reading);
      // In a file the word says it.
      if (!reading.HasError(path) && !(value > 0.0))
      {
         reading.AddError(path, "found " + ToText(value) +
                                   "; it must be positive, or \"" + auto_word +
                                   "\"");
      }
   }
   std::optional<real_t> Number() const override { return value; }

private:
   real_t &value;
};
} // namespace

bool KeyRange::Has(real_t value) const
{
   return open ? value > least && value < most
               : value >= least && value <= most;
}

std::string KeyRange::Text() const
{
   const bool below = std::isfinite(most);
   if (!std::isfinite(least) && !below)
   {
      return "";
   }
   if (below)
   {
      return std::string(open ? "between " : "from ") + ToText(least) +
             (open ? " and " : " to ") + ToText(most);
   }
   return open && least == 0.0 ? "positive" : "at least " + ToText(least);
}

CaseKey &CaseKey::Required()
{
   required = true;
   return *this;
}

CaseKey &CaseKey::Formerly(const std::string &former_name_)
{
   former_name = former_name_;
   return *this;
}

const CaseValue *CaseKey::FindIn(const CaseValue &from) const
{
   const CaseValue *value = from.Find(name);
   return value || former_name.empty() ? value : from.Find(former_name);
}

CaseKey &CaseKey::OnlyFor(const std::string &word)
{
   only_for = word;
   return *this;
}

CaseKey &CaseKey::Named(const std::string &noun_)
{
   noun = noun_;
   return *this;
}

CaseKey &CaseKey::Positive()
{
   range.least = 0.0;
   range.open = true;
   return *this;
}

CaseKey &CaseKey::AtLeast(real_t least)
{
   range.least = least;
   return *this;
}

CaseKey &CaseKey::From(real_t least, real_t most)
{
   range.least = least;
   range.most = most;
   return *this;
}

CaseKey &CaseKey::Inside(real_t least, real_t most)
{
   From(least, most);
   range.open = true;
   return *this;
}

int ReadWord(const CaseValue &from, const std::string &path,
             const std::vector<std::string> &words, CaseReading &reading)
{
   if (from.type != CaseValue::Type::text)
   {
      reading.Expect(path, WordsType(words), from);
      return -1;
   }
   const auto found = std::find(words.begin(), words.end(), from.text);
   if (found == words.end())
   {
      reading.AddError(path, "found " + from.Describe() + "; expected " +
                                WordsType(words) +
                                DidYouMean(from.text, words));
      return -1;
   }
   return static_cast<int>(found - words.begin());
}

std::string WordsType(const std::vector<std::string> &words)
{
   std::string text;
   for (size_t i = 0; i < words.size(); i++)
   {
      const bool last = i + 1 == words.size();
      text += (i == 0 ? "" : last ? " or " : ", ") + Quoted(words[i]);
   }
   return text;
}

CaseKey &KeyTable::Add(const std::string &name, const std::string &unit,
                       const std::string &meaning)
{
   keys.emplace_back();
   keys.back().name = name;
   keys.back().unit = unit;
   keys.back().meaning = meaning;
   return keys.back();
}

CaseKey &KeyTable::Auto(const std::string &name, real_t &value,
                        const std::string &unit, const std::string &meaning)
{
   CaseKey &key = Add(name, unit, meaning);
   key.value = std::make_unique<AutoBinding>(value);
   return key.AtLeast(0.0);
}

CaseKey &KeyTable::Table(const std::string &name, KeyTable table,
                         const std::string &meaning)
{
   CaseKey &key = Add(name, "", meaning);
   key.table = std::make_unique<KeyTable>(std::move(table));
   return key;
}

const CaseKey *KeyTable::Find(const std::string &name) const
{
   for (const CaseKey &key : keys)
   {
      if (key.name == name ||
          (!key.former_name.empty() && key.former_name == name))
      {
         return &key;
      }
   }
   return nullptr;
}

std::vector<std::string> KeyTable::Names() const
{
   std::vector<std::string> names;
   for (const CaseKey &key : keys)
   {
      names.push_back(key.name);
   }
   return names;
}

std::string KeyTable::ModelKey() const
{
   return Find("model") ? "model" : "type";
}

std::string KeyTable::Model() const
{
   const CaseKey *model = Find(ModelKey());
   return model ? model->value->Text().value_or("") : "";
}

bool KeyTable::Applies(const CaseKey &key) const
{
   return key.only_for.empty() || Quoted(key.only_for) == Model();
}

void KeyTable::ReadList(CaseKey &key, const CaseValue &from,
                        const std::string &path, CaseReading &reading)
{
   const auto is_table = [](const CaseValue &item)
   { return item.type == CaseValue::Type::table; };
   if (from.type != CaseValue::Type::list ||
       !std::all_of(from.items.begin(), from.items.end(), is_table))
   {
      reading.Expect(
         path, "tables, each of them under a line [[" + key.name + "]]", from);
      return;
   }
   key.list->resize(from.items.size());
   for (size_t i = 0; i < from.items.size(); i++)
   {
      const std::string here = Joined(path, std::to_string(i));
      reading.SetPlace(here, from.items[i].place);
      key.list->entry(i).Read(from.items[i], here, reading);
   }
}

void KeyTable::ReadKey(CaseKey &key, const CaseValue &from,
                       const std::string &path, CaseReading &reading)
{
   if (key.value)
   {
      key.value->Read(from, path, reading);
   }
   else if (key.table)
   {
      key.table->Read(from, path, reading);
   }
   else
   {
      ReadList(key, from, path, reading);
   }
}

void KeyTable::Read(const CaseValue &from, const std::string &path,
                    CaseReading &reading)
{
   if (from.type != CaseValue::Type::table)
   {
      reading.Expect(path, "a table", from);
      return;
   }
   for (const CaseValue::Member &member : from.members)
   {
      const std::string here = Joined(path, member.key);
      if (!Find(member.key))
      {
         reading.SetPlace(here, member.place);
         reading.AddError(
            here, "there is no such key; there are: " + JoinedNames(Names()) +
                     DidYouMean(member.key, Names()));
      }
   }
   for (CaseKey &key : keys)
   {
      if (const CaseValue *value = key.FindIn(from))
      {
         const std::string here = Joined(path, key.name);
         reading.SetPlace(here, value->place);
         ReadKey(key, *value, here, reading);
      }
   }
   for (CaseKey &key : keys)
   {
      const std::string here = Joined(path, key.name);
      const bool given = key.FindIn(from) != nullptr;
      if (!key.former_name.empty() && from.Find(key.former_name) &&
          from.Find(key.name))
      {
         reading.AddError(here, "it is there as \"" + key.former_name +
                                   "\", its former name, too");
      }
      if (!key.only_for.empty() && reading.HasError(Joined(path, ModelKey())))
      {
         continue; // nobody knows for what
      }
      if (given && !Applies(key))
      {
         reading.AddError(here, "this goes with " + Quoted(key.only_for) +
                                   ", not with " + Model());
      }
      else if (!given && key.required && Applies(key))
      {
         reading.AddError(here,
                          "this is missing" + (key.meaning.empty()
                                                  ? std::string()
                                                  : " (" + key.meaning + ")"));
      }
      else if (!given && key.table)
      {
         CaseValue nothing;
         nothing.place = from.place;
         key.table->Read(nothing, here, reading);
      }
   }
}

void KeyTable::Check(const std::string &path, CaseReading &reading)
{
   for (CaseKey &key : keys)
   {
      const std::string here = Joined(path, key.name);
      if (!Applies(key) || reading.HasError(here))
      {
         continue;
      }
      if (key.table)
      {
         key.table->Check(here, reading);
      }
      for (size_t i = 0; key.list && i < key.list->size(); i++)
      {
         key.list->entry(i).Check(Joined(here, std::to_string(i)), reading);
      }
      const std::optional<real_t> number =
         key.value ? key.value->Number() : std::nullopt;
      if (number && !key.range.Has(*number))
      {
         reading.AddError(
            here, (key.noun.empty() ? "found " : key.noun + " is ") +
                     ToText(*number) + "; it must be " + key.range.Text());
      }
   }
}

TomlText KeyTable::Inline()
{
   std::string text;
   for (CaseKey &key : keys)
   {
      if (!Applies(key) || key.list)
      {
         continue;
      }
      const TomlText value =
         key.table ? key.table->Inline() : key.value->Text();
      if (value)
      {
         text += (text.empty() ? "" : ", ") + key.name + " = " + *value;
      }
   }
   return text.empty() ? TomlText() : "{" + text + "}";
}

void KeyTable::Write(std::ostream &out, const std::string &path)
{
   // Tables at the top get a line of their own, those in them are inline.
   const auto has_section = [&](const CaseKey &key)
   { return key.list || (key.table && path.empty()); };
   for (CaseKey &key : keys)
   {
      if (!has_section(key) && Applies(key))
      {
         const TomlText value =
            key.table ? key.table->Inline() : key.value->Text();
         if (value)
         {
            out << key.name << " = " << *value << '\n';
         }
      }
   }
   for (CaseKey &key : keys)
   {
      const std::string here = Joined(path, key.name);
      if (!has_section(key))
      {
         continue;
      }
      if (key.table)
      {
         out << "\n[" << here << "]\n";
         key.table->Write(out, here);
      }
      for (size_t i = 0; key.list && i < key.list->size(); i++)
      {
         out << "\n[[" << here << "]]\n";
         key.list->entry(i).Write(out, here);
      }
   }
}

void KeyTable::Values(const std::string &path,
                      std::vector<std::pair<std::string, std::string>> &values)
{
   for (CaseKey &key : keys)
   {
      const std::string here = Joined(path, key.name);
      if (!Applies(key))
      {
         continue;
      }
      if (key.value)
      {
         if (const TomlText text = key.value->Text())
         {
            values.emplace_back(here, *text);
         }
      }
      else if (key.table)
      {
         key.table->Values(here, values);
      }
      for (size_t i = 0; key.list && i < key.list->size(); i++)
      {
         key.list->entry(i).Values(Joined(here, std::to_string(i)), values);
      }
   }
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
      if (!key.only_for.empty())
      {
         notes += "; for " + Quoted(key.only_for);
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
      if (key.list)
      {
         key.list->sample([&](KeyTable &sample)
                          { sample.Collect(here + ".N", lines); });
      }
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
