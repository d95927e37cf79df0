#include "synovia/cases/key_names.hpp"
#include "synovia/cases/key_table.hpp"
#include "synovia/general/text.hpp"

#include <algorithm>

namespace synovia
{

using namespace mfem;

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

void KeyTable::ReadList(CaseKey &key, const CaseValue &from,
                        const std::string &path, CaseReading &reading)
{
   const auto is_table = [](const CaseValue &item)
   { return item.type == CaseValue::Type::table; };
   if (from.type != CaseValue::Type::list ||
       !std::all_of(from.items.begin(), from.items.end(), is_table))
   {
      reading.Expect(path,
                     "tables, each of them under a line [[" + key.name +
                        "]], or all in one list",
                     from);
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
   ReadChoice(from, path, reading);
   RefuseUnknown(from, path, reading);
   for (CaseKey &key : keys)
   {
      const CaseValue *value = key.FindIn(from);
      if (value && !(chosen && chosen->key == key.name))
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
      if (!given && key.required)
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

void KeyTable::ReadChoice(const CaseValue &from, const std::string &path,
                          CaseReading &reading)
{
   if (!chosen)
   {
      return;
   }
   const std::string here = Joined(path, chosen->key);
   if (const CaseValue *value = from.Find(chosen->key))
   {
      reading.SetPlace(here, value->place);
      const auto key = std::find_if(keys.begin(), keys.end(),
                                    [&](const CaseKey &one)
                                    { return one.name == chosen->key; });
      key->value->Read(*value, here, reading);
   }
   if (!reading.HasError(here))
   {
      AddChosen();
   }
}

void KeyTable::RefuseUnknown(const CaseValue &from, const std::string &path,
                             CaseReading &reading) const
{
   for (const CaseValue::Member &member : from.members)
   {
      if (Find(member.key))
      {
         continue;
      }
      const std::string here = Joined(path, member.key);
      const std::string others = chosen ? chosen->ThoseWith(member.key) : "";
      reading.SetPlace(here, member.place);
      if (others.empty())
      {
         reading.AddError(
            here, "there is no such key; there are: " + JoinedNames(Names()) +
                     DidYouMean(member.key, Names()));
      }
      else if (chosen->added) // else nobody knows what it is to go with
      {
         reading.AddError(here, "this goes with " + others + ", not with " +
                                   Quoted(*chosen->word));
      }
   }
}

void KeyTable::Check(const std::string &path, CaseReading &reading)
{
   if (chosen && !reading.HasError(Joined(path, chosen->key)))
   {
      AddChosen();
      if (!chosen->added)
      {
         reading.AddError(Joined(path, chosen->key),
                          "there is no " + Quoted(*chosen->word));
      }
   }
   for (CaseKey &key : keys)
   {
      const std::string here = Joined(path, key.name);
      if (reading.HasError(here))
      {
         continue;
      }
      if (key.required && key.value && !key.value->IsSet())
      {
         reading.AddError(here, "this is missing (" + key.meaning + ")");
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

} // namespace synovia
