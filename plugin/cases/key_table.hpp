#pragma once

#include "synovia/cases/case_codec.hpp"
#include "synovia/cases/case_words.hpp"
#include "synovia/general/number_range.hpp"

#include <functional>
#include <iosfwd>
#include <memory>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace synovia
{

/// One value of a program that a key stands for.
class KeyBinding
{
public:
   virtual ~KeyBinding() = default;
   virtual std::string Type() const = 0;
   /// The present value as TOML, if it is set.
   virtual TomlText Text() const = 0;
   /// Whether it has a value, for what can be without.
   virtual bool IsSet() const { return true; }
   virtual void Read(const CaseInput &from) = 0;
   /// The present value where it is one number.
   virtual std::optional<mfem::real_t> Number() const { return std::nullopt; }
};

class KeyTable;

/// A key: what it is called, what it means, and what it is bound to: a value, a
/// table, or a list of tables.
struct CaseKey
{
   std::string name;
   /// A former name that files may still use; empty for none.
   std::string former_name;
   std::string unit;
   std::string meaning;
   /// What messages call the value, if not by its path.
   std::string noun;
   NumberRange range;
   bool required = false;

   std::unique_ptr<KeyBinding> value;
   std::unique_ptr<KeyTable> table;

   /// A list of tables: its size, how to resize it, the keys of an entry, and
   /// the keys of a sample for the list of keys, unless they are listed
   /// elsewhere.
   struct List
   {
      std::function<size_t()> size;
      std::function<void(size_t)> resize;
      std::function<KeyTable(size_t)> entry;
      std::function<void(const std::function<void(KeyTable &)> &)> sample;
   };
   std::unique_ptr<List> list;

   /// What @a from has under the name, or under the former one.
   const CaseValue *FindIn(const CaseValue &from) const;

   CaseKey &Required();
   CaseKey &Formerly(const std::string &former_name_);
   CaseKey &Named(const std::string &noun_);
   CaseKey &In(const NumberRange &range_);
   CaseKey &Positive() { return In(NumberRange::Positive()); }
   CaseKey &AtLeast(mfem::real_t a) { return In(NumberRange::AtLeast(a)); }
   /// Between the two, which are allowed too, or are not.
   CaseKey &From(mfem::real_t a, mfem::real_t b)
   {
      return In(NumberRange::From(a, b));
   }
   CaseKey &Inside(mfem::real_t a, mfem::real_t b)
   {
      return In(NumberRange::Inside(a, b));
   }
};

/// The keys of a table, bound to the members of a struct that must outlive it.
///
/// One description of the keys serves to read a case, to check one that a
/// program made, to write it, and to list the keys.
class KeyTable
{
public:
   /// A word that a key may have, and what it stands for.
   struct Alternative
   {
      std::string word;
      std::string meaning;
   };

   template <typename T>
   CaseKey &Value(const std::string &name, T &value, const std::string &unit,
                  const std::string &meaning);
   /// A number or "auto", which is 0 in @a value.
   CaseKey &Auto(const std::string &name, mfem::real_t &value,
                 const std::string &unit, const std::string &meaning);
   template <typename Enum>
   CaseKey &Word(const std::string &name, Enum &value,
                 const KeyWords<Enum> &words, const std::string &meaning);
   CaseKey &Table(const std::string &name, KeyTable table,
                  const std::string &meaning);
   /// A word that further keys depend on: @a describe gives those that go with
   /// one of the alternatives. A table has one such key at most.
   CaseKey &Choice(const std::string &name, std::string &word,
                   const std::vector<Alternative> &alternatives,
                   std::function<KeyTable(const std::string &)> describe,
                   const std::string &meaning);
   /// The same for words that stand for values, with a meaning for each.
   template <typename Enum>
   CaseKey &
   Choice(const std::string &name, Enum &value, const KeyWords<Enum> &words,
          const std::vector<std::string> &meanings,
          std::function<KeyTable(Enum)> describe, const std::string &meaning);
   /// A value with a binding of its own.
   CaseKey &Bind(const std::string &name, std::unique_ptr<KeyBinding> binding,
                 const std::string &unit, const std::string &meaning);
   template <typename Entry>
   CaseKey &List(const std::string &name, std::vector<Entry> &entries,
                 KeyTable (*describe)(Entry &), const std::string &meaning);

   /// Sets the values that @a from has; adds errors for unknown keys, wrong
   /// types and missing keys.
   void Read(const CaseInput &from);
   /// Adds errors for numbers out of range at paths that have no error yet.
   void Check(const std::string &path, CaseReading &reading);
   /// Writes all values that are set, as TOML.
   void Write(std::ostream &out, const std::string &path = "");
   /// Adds the paths of all values that are set, with the values as TOML.
   void Values(const std::string &path,
               std::vector<std::pair<std::string, std::string>> &values);
   /// Lists all keys with types, defaults, units and meanings.
   void List(std::ostream &out);

private:
   struct Line
   {
      std::string key;
      std::string type;
      std::string standard;
      std::string unit;
      std::string meaning;

      bool operator==(const Line &other) const;
   };

   /// What a word chooses.
   struct Chosen
   {
      std::string key;
      /// The present one.
      std::function<std::string()> word;
      std::vector<Alternative> alternatives;
      std::function<KeyTable(const std::string &)> describe;
      /// Whether the keys that go with the word are among the table's.
      bool added = false;

      bool IsValid() const;
      /// The alternatives that have a key, in quotes.
      std::string ThoseWith(const std::string &name) const;
   };

   CaseKey &Add(const std::string &name, const std::string &unit,
                const std::string &meaning);
   const CaseKey *Find(const std::string &name) const;
   std::vector<std::string> Names() const;
   /// Adds the keys that go with the present word, once there is a valid one.
   void AddChosen();
   void ReadChoice(const CaseInput &from);
   void RefuseUnknown(const CaseInput &from) const;
   static void ReadKey(CaseKey &key, const CaseInput &from);
   static void ReadList(CaseKey &key, const CaseInput &from);
   TomlText Inline();
   static TomlText InlineValue(CaseKey &key);
   void Collect(const std::string &path, std::vector<Line> &lines);
   void CollectChoice(const std::string &path, std::vector<Line> &lines) const;

   std::vector<CaseKey> keys;
   std::optional<Chosen> chosen;
};

template <typename T>
class ValueBinding : public KeyBinding
{
public:
   explicit ValueBinding(T &value_) : value(value_) {}
   std::string Type() const override { return type_name<T>; }
   TomlText Text() const override { return TextOf(value); }
   void Read(const CaseInput &from) override { ReadValue(from, value); }
   std::optional<mfem::real_t> Number() const override
   {
      if constexpr (std::is_arithmetic_v<T> && !std::is_same_v<T, bool>)
      {
         return static_cast<mfem::real_t>(value);
      }
      return std::nullopt;
   }

private:
   T &value;
};

/// Reads one of @a words: its number, or -1 after an error.
int ReadWord(const CaseInput &from, const std::vector<std::string> &words);
/// The words as a type: "a", "b" or "c".
std::string WordsType(const std::vector<std::string> &words);

template <typename Enum>
class WordBinding : public KeyBinding
{
public:
   WordBinding(Enum &value_, const KeyWords<Enum> &words) : value(value_)
   {
      for (const auto &[name, meaning] : words)
      {
         names.push_back(name);
         meanings.push_back(meaning);
      }
   }
   std::string Type() const override { return WordsType(names); }
   TomlText Text() const override
   {
      for (size_t i = 0; i < names.size(); i++)
      {
         if (meanings[i] == value)
         {
            return Quoted(names[i]);
         }
      }
      return std::nullopt;
   }
   void Read(const CaseInput &from) override
   {
      const int word = ReadWord(from, names);
      if (word >= 0)
      {
         value = meanings[word];
      }
   }

private:
   Enum &value;
   std::vector<std::string> names;
   std::vector<Enum> meanings;
};

/// A word that chooses further keys: they are listed with each of the words.
template <typename Value>
class ChoiceBinding : public WordBinding<Value>
{
public:
   using WordBinding<Value>::WordBinding;
   std::string Type() const override { return "word"; }
};

template <typename T>
CaseKey &KeyTable::Value(const std::string &name, T &value,
                         const std::string &unit, const std::string &meaning)
{
   CaseKey &key = Add(name, unit, meaning);
   key.value = std::make_unique<ValueBinding<T>>(value);
   return key;
}

template <typename Enum>
CaseKey &KeyTable::Word(const std::string &name, Enum &value,
                        const KeyWords<Enum> &words, const std::string &meaning)
{
   CaseKey &key = Add(name, "", meaning);
   key.value = std::make_unique<WordBinding<Enum>>(value, words);
   return key;
}

template <typename Enum>
CaseKey &KeyTable::Choice(const std::string &name, Enum &value,
                          const KeyWords<Enum> &words,
                          const std::vector<std::string> &meanings,
                          std::function<KeyTable(Enum)> describe,
                          const std::string &meaning)
{
   std::vector<Alternative> alternatives;
   for (size_t i = 0; i < words.size(); i++)
   {
      alternatives.push_back({words[i].first, meanings[i]});
   }
   chosen = Chosen{name, [&value, words]() { return WordFor(value, words); },
                   alternatives,
                   [words, describe](const std::string &word)
                   { return describe(ValueOf(word, words)); }};
   return Bind(name, std::make_unique<ChoiceBinding<Enum>>(value, words), "",
               meaning);
}

template <typename Entry>
CaseKey &KeyTable::List(const std::string &name, std::vector<Entry> &entries,
                        KeyTable (*describe)(Entry &),
                        const std::string &meaning)
{
   CaseKey &key = Add(name, "", meaning);
   key.list = std::make_unique<CaseKey::List>();
   key.list->size = [&entries]() { return entries.size(); };
   key.list->resize = [&entries](size_t size) { entries.resize(size); };
   key.list->entry = [&entries, describe](size_t i)
   { return describe(entries[i]); };
   key.list->sample = [describe](const std::function<void(KeyTable &)> &show)
   {
      Entry sample;
      KeyTable table = describe(sample);
      show(table);
   };
   return key;
}

} // namespace synovia
