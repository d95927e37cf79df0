#include "synovia/cases/case_value.hpp"
#include "synovia/general/error.hpp"
#include "synovia/general/suggestion.hpp"

namespace synovia
{

namespace
{
// The keys between the dots; keys with dots are in quotes. Empty if it can't be
// read.
std::vector<std::string> SplitPath(const std::string &path)
{
   std::vector<std::string> keys;
   size_t i = 0;
   while (true)
   {
      std::string key;
      if (i < path.size() && (path[i] == '"' || path[i] == '\''))
      {
         const size_t end = path.find(path[i], i + 1);
         if (end == std::string::npos)
         {
            return {};
         }
         key = path.substr(i + 1, end - i - 1);
         i = end + 1;
      }
      else
      {
         const size_t end = std::min(path.find('.', i), path.size());
         key = path.substr(i, end - i);
         i = end;
      }
      if (key.empty() || (i < path.size() && path[i] != '.'))
      {
         return {};
      }
      keys.push_back(key);
      if (i >= path.size())
      {
         return keys;
      }
      i++;
   }
}

void SetPlace(CaseValue &value, const CasePlace &place)
{
   value.place = place;
   for (CaseValue &item : value.items)
   {
      SetPlace(item, place);
   }
   for (CaseValue::Member &member : value.members)
   {
      member.place = place;
      SetPlace(member.value, place);
   }
}

// By what an entry of a list may be called.
std::vector<std::string> NamesOf(const CaseValue &entry)
{
   std::vector<std::string> names;
   for (const char *key : {"name", "regions", "surfaces"})
   {
      const CaseValue *value = entry.Find(key);
      if (value && value->type == CaseValue::Type::text)
      {
         names.push_back(value->text);
      }
      if (value && value->type == CaseValue::Type::list)
      {
         for (const CaseValue &item : value->items)
         {
            names.push_back(item.text);
         }
      }
   }
   return names;
}

/// One override, with what its errors say.
class Assignment
{
public:
   explicit Assignment(const std::string &text_) : text(text_)
   {
      const size_t equals = text.find('=');
      if (equals == std::string::npos)
      {
         Fail("write it as key.path=value");
      }
      std::string path = text.substr(0, equals);
      path.erase(0, path.find_first_not_of(' '));
      path.erase(path.find_last_not_of(' ') + 1);
      keys = SplitPath(path);
      if (keys.empty())
      {
         Fail("\"" + path + "\" is not a path of keys, such as time.step");
      }
      value = Parse(text.substr(equals + 1));
      SetPlace(value, Place());
   }

   void Apply(CaseValue &root) const
   {
      CaseValue *at = &root;
      for (size_t i = 0; i < keys.size(); i++)
      {
         at = at->type == CaseValue::Type::list ? &Entry(*at, keys[i])
                                                : &Member(*at, keys[i]);
      }
      *at = value;
   }

private:
   CasePlace Place() const { return {"--set " + text, 0, 0}; }

   [[noreturn]] void Fail(const std::string &reason) const
   {
      throw Error("--set " + text + ": " + reason);
   }

   CaseValue Parse(const std::string &written) const
   {
      CaseValue table;
      try
      {
         table = ParseToml("value = " + written, "value");
      }
      catch (const Error &)
      {
      }
      // More than one line could set more than one key.
      if (table.members.size() != 1)
      {
         Fail("\"" + written +
              "\" is no value of TOML; strings need double "
              "quotes, and those need quotes of the shell: '\"" +
              written + "\"'");
      }
      return table.members.front().value;
   }

   CaseValue &Member(CaseValue &table, const std::string &key) const
   {
      if (table.type != CaseValue::Type::table)
      {
         Fail("there is no \"" + key + "\" in " + table.Describe());
      }
      if (CaseValue *found = table.Find(key))
      {
         return *found;
      }
      CaseValue fresh;
      fresh.place = Place();
      table.members.push_back({key, Place(), fresh});
      return table.members.back().value;
   }

   CaseValue &Entry(CaseValue &list, const std::string &key) const
   {
      if (key.find_first_not_of("0123456789") == std::string::npos)
      {
         const size_t i = key.size() < 9 ? std::stoul(key) : list.items.size();
         if (i >= list.items.size())
         {
            Fail("there is no entry " + key + ": the list has " +
                 std::to_string(list.items.size()) + ", counted from 0");
         }
         return list.items[i];
      }
      CaseValue *found = nullptr;
      std::vector<std::string> known;
      for (CaseValue &entry : list.items)
      {
         for (const std::string &name : NamesOf(entry))
         {
            known.push_back(name);
            if (name == key && found && found != &entry)
            {
               Fail("several entries are called \"" + key +
                    "\"; use the number of one, from 0");
            }
            found = name == key ? &entry : found;
         }
      }
      if (!found)
      {
         const std::string guess = Suggest(key, known);
         Fail("no entry is called \"" + key + "\"" +
              (guess.empty() ? "; use its number, from 0"
                             : "; did you mean \"" + guess + "\"?"));
      }
      return *found;
   }

   std::string text;
   std::vector<std::string> keys;
   CaseValue value;
};
} // namespace

void Override(CaseValue &root, const std::string &assignment)
{
   Assignment(assignment).Apply(root);
}

} // namespace synovia
