#include "synovia/cases/key_names.hpp"
#include "synovia/cases/key_table.hpp"
#include "synovia/general/text.hpp"

#include <algorithm>

namespace synovia
{

using namespace mfem;

int ReadWord(const CaseInput &from, const std::vector<std::string> &words)
{
   if (!from.Is(CaseValue::Type::text))
   {
      from.Expect(WordsType(words));
      return -1;
   }
   const auto found = std::find(words.begin(), words.end(), from->text);
   if (found == words.end())
   {
      from.Expect(WordsType(words) + DidYouMean(from->text, words));
      return -1;
   }
   return static_cast<int>(found - words.begin());
}

void KeyTable::ReadList(CaseKey &key, const CaseInput &from)
{
   const auto is_table = [](const CaseValue &item)
   { return item.type == CaseValue::Type::table; };
   if (!from.Is(CaseValue::Type::list) ||
       !std::all_of(from->items.begin(), from->items.end(), is_table))
   {
      from.Expect("tables, each of them under a line [[" + key.name +
                  "]], or all in one list");
      return;
   }
   key.list->resize(from->items.size());
   for (size_t i = 0; i < from->items.size(); i++)
   {
      key.list->entry(i).Read(from.Item(i));
   }
}

void KeyTable::ReadKey(CaseKey &key, const CaseInput &from)
{
   if (key.value)
   {
      key.value->Read(from);
   }
   else if (key.table)
   {
      key.table->Read(from);
   }
   else
   {
      ReadList(key, from);
   }
}

void KeyTable::Read(const CaseInput &from)
{
   if (!from.Is(CaseValue::Type::table))
   {
      from.Expect("a table");
      return;
   }
   ReadChoice(from);
   RefuseUnknown(from);
   for (CaseKey &key : keys)
   {
      const CaseValue *const value = key.FindIn(from.Value());
      if (value && !(chosen && chosen->key == key.name))
      {
         ReadKey(key, from.Member(key.name, *value));
      }
   }
   for (CaseKey &key : keys)
   {
      const std::string here = Joined(from.Path(), key.name);
      const bool given = key.FindIn(from.Value()) != nullptr;
      if (!key.former_name.empty() && from->Find(key.former_name) &&
          from->Find(key.name))
      {
         from.Reading().AddError(here, "it is there as " +
                                          Quoted(key.former_name) +
                                          ", its former name, too");
      }
      if (!given && key.required)
      {
         from.Reading().AddError(
            here, "this is missing" +
                     (key.meaning.empty() ? "" : " (" + key.meaning + ")"));
      }
      else if (!given && key.table)
      {
         key.table->Read(CaseInput(CaseValue(), here, from.Reading()));
      }
   }
}

void KeyTable::ReadChoice(const CaseInput &from)
{
   if (!chosen)
   {
      return;
   }
   if (const CaseValue *value = from->Find(chosen->key))
   {
      const auto key = std::find_if(keys.begin(), keys.end(),
                                    [&](const CaseKey &one)
                                    { return one.name == chosen->key; });
      key->value->Read(from.Member(chosen->key, *value));
   }
   if (!from.Reading().HasError(Joined(from.Path(), chosen->key)))
   {
      AddChosen();
   }
}

void KeyTable::RefuseUnknown(const CaseInput &from) const
{
   for (const CaseValue::Member &member : from->members)
   {
      if (Find(member.key))
      {
         continue;
      }
      CaseReading &reading = from.Reading();
      const std::string here = Joined(from.Path(), member.key);
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
                                   Quoted(chosen->word()));
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
                          "there is no " + Quoted(chosen->word()));
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
