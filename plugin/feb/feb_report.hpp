#pragma once

#include "synovia/feb/feb_element.hpp"

#include <iosfwd>
#include <string>
#include <unordered_set>
#include <vector>

namespace synovia
{

/// What became of each element and attribute of a model: it was read, or it is
/// listed here, with the reason.
class FebReport
{
public:
   enum class Fate
   {
      /// Has no effect on the result here.
      ignored,
      /// Something near it is computed.
      approximated,
      /// Stops the import.
      unsupported
   };

   /// Lists what is at @a path (such as Control/solver) in @a line.
   void List(Fate fate, int line, const std::string &path,
             const std::string &text);

   /// Elements and attributes that were looked at.
   void MarkRead(const void *part) { read.insert(part); }
   bool IsRead(const void *part) const { return read.count(part) > 0; }

   /// Lists all that nothing asked for in @a root as unsupported.
   void ListUnread(const FebElement &root);

   bool IsStopped() const;

   /// The entries of the fate, one for each path and text, in the order of the
   /// file; empty if there is none.
   std::string Text(Fate fate) const;
   /// All of it, under headings.
   void Print(const std::string &source, std::ostream &out) const;

private:
   struct Entry
   {
      Fate fate;
      std::string path;
      std::string text;
      std::vector<int> lines;
   };

   void ListUnread(const FebElement &element, const std::string &path);

   std::vector<Entry> entries;
   std::unordered_set<const void *> read;
};

} // namespace synovia
