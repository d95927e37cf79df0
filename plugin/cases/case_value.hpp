#pragma once

#include <string>
#include <vector>

namespace synovia
{

/// Where a part of a case was written, for messages.
struct CasePlace
{
   /// A file, or the option that set it; empty if a program did.
   std::string source;
   /// From 1; 0 where the source has no lines.
   int line = 0;
   int column = 0;
};

/// "file:line:column", as far as it is known.
std::string ToText(const CasePlace &place);

/// A part of a case as it was written: a tree of tables, lists and values.
struct CaseValue
{
   enum class Type
   {
      boolean,
      integer,
      number,
      text,
      date,
      list,
      table
   };
   struct Member;

   Type type = Type::table;
   CasePlace place;
   bool boolean = false;
   long long integer = 0;
   /// Of integers too.
   double number = 0.0;
   std::string text;
   std::vector<CaseValue> items;
   std::vector<Member> members;

   /// The member of this name, or null.
   CaseValue *Find(const std::string &key);
   const CaseValue *Find(const std::string &key) const;

   /// What it is, in words, such as 'the string "two"'.
   std::string Describe() const;
};

struct CaseValue::Member
{
   std::string key;
   CasePlace place;
   CaseValue value;
};

/// Reads TOML. Throws Error with file, line and column if it isn't any.
CaseValue ParseToml(const std::string &text, const std::string &source);

/// Sets what "key.path=value" says in @a root. The path goes through tables by
/// key, and through lists by number from 0 or by the name of an entry: its
/// name, or one of its regions or surfaces. Throws Error, which names the
/// assignment, if it can't.
void Override(CaseValue &root, const std::string &assignment);

/// A string as TOML writes it.
std::string Quoted(const std::string &text);
/// The shortest TOML number that reads back as this one.
std::string ShortestNumber(double value);

} // namespace synovia
