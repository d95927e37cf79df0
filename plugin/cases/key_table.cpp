#include "synovia/cases/key_table.hpp"
#include "synovia/general/text.hpp"

#include <algorithm>
#include <iterator>

namespace synovia
{

using namespace mfem;

namespace
{
constexpr const char *auto_word = "auto";

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
   void Read(const CaseInput &from) override
   {
      if (from.Is(CaseValue::Type::text))
      {
         if (ReadWord(from, {auto_word}) == 0)
         {
            value = 0.0;
         }
         return;
      }
      ReadValue(from, value);
      // In a file the word says it.
      if (!from.HasError() && !(value > 0.0))
      {
         from.AddError("found " + ToText(value) + "; it must be positive, or " +
                       Quoted(auto_word));
      }
   }
   std::optional<real_t> Number() const override { return value; }

private:
   real_t &value;
};
} // namespace

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

CaseKey &CaseKey::Named(const std::string &noun_)
{
   noun = noun_;
   return *this;
}

CaseKey &CaseKey::In(const NumberRange &range_)
{
   range = range_;
   return *this;
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
   return Bind(name, std::make_unique<AutoBinding>(value), unit, meaning)
      .AtLeast(0.0);
}

CaseKey &KeyTable::Bind(const std::string &name,
                        std::unique_ptr<KeyBinding> binding,
                        const std::string &unit, const std::string &meaning)
{
   CaseKey &key = Add(name, unit, meaning);
   key.value = std::move(binding);
   return key;
}

CaseKey &KeyTable::Choice(const std::string &name, std::string &word,
                          const std::vector<Alternative> &alternatives,
                          std::function<KeyTable(const std::string &)> describe,
                          const std::string &meaning)
{
   KeyWords<std::string> words;
   for (const Alternative &alternative : alternatives)
   {
      words.emplace_back(alternative.word, alternative.word);
   }
   chosen = Chosen{name, [&word]() { return word; }, alternatives,
                   std::move(describe)};
   return Bind(name, std::make_unique<ChoiceBinding<std::string>>(word, words),
               "", meaning);
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

bool KeyTable::Chosen::IsValid() const
{
   return std::any_of(alternatives.begin(), alternatives.end(),
                      [&](const Alternative &alternative)
                      { return alternative.word == word(); });
}

std::string KeyTable::Chosen::ThoseWith(const std::string &name) const
{
   std::vector<std::string> words;
   for (const Alternative &alternative : alternatives)
   {
      if (describe(alternative.word).Find(name))
      {
         words.push_back(alternative.word);
      }
   }
   return words.empty() ? "" : WordsType(words);
}

void KeyTable::AddChosen()
{
   if (chosen && !chosen->added && chosen->IsValid())
   {
      KeyTable further = chosen->describe(chosen->word());
      std::move(further.keys.begin(), further.keys.end(),
                std::back_inserter(keys));
      chosen->added = true;
   }
}

} // namespace synovia
