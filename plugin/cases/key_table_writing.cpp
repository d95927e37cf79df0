#include "synovia/cases/key_names.hpp"
#include "synovia/cases/key_table.hpp"

#include <ostream>

namespace synovia
{

using namespace mfem;

TomlText KeyTable::InlineValue(CaseKey &key)
{
   if (key.table)
   {
      return key.table->Inline();
   }
   if (key.value)
   {
      return key.value->Text();
   }
   std::string entries;
   for (size_t i = 0; i < key.list->size(); i++)
   {
      entries +=
         (i > 0 ? ", " : "") + key.list->entry(i).Inline().value_or("{}");
   }
   return "[" + entries + "]";
}

TomlText KeyTable::Inline()
{
   AddChosen();
   std::string text;
   for (CaseKey &key : keys)
   {
      const TomlText value = InlineValue(key);
      if (value)
      {
         text += (text.empty() ? "" : ", ") + key.name + " = " + *value;
      }
   }
   return text.empty() ? TomlText() : "{" + text + "}";
}

void KeyTable::Write(std::ostream &out, const std::string &path)
{
   AddChosen();
   // Tables at the top get a line of their own, those in them are inline.
   const auto has_section = [&](const CaseKey &key)
   { return key.list || (key.table && path.empty()); };
   for (CaseKey &key : keys)
   {
      if (!has_section(key))
      {
         const TomlText value = InlineValue(key);
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
   AddChosen();
   for (CaseKey &key : keys)
   {
      const std::string here = Joined(path, key.name);
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

} // namespace synovia
