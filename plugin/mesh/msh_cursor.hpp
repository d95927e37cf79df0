#pragma once

#include <cstddef>
#include <string>

namespace synovia
{

/// Reads an MSH file from front to back and knows where it is.
///
/// Every reading method throws Error, with the place, where the file is cut off
/// or something else is found.
class MshCursor
{
public:
   explicit MshCursor(std::string text);

   /// Whether the numbers to come are binary.
   bool binary = false;

   /// Throws Error: @a what and the line of a text or the byte of a binary.
   [[noreturn]] void Fail(const std::string &what) const;

   /// The rest of the current line, without its end.
   std::string Line();

   /// Gives the name of the next section; false at the end of the file.
   bool NextSection(std::string &name);

   /// Goes on past the end of the section, where it must be.
   void EndSection(const std::string &name);

   /// Goes on past the end of the section, wherever it is.
   void SkipSection(const std::string &name);

   /// An int, of 4 bytes.
   int Int();

   /// A count or a number that is not negative, of 8 bytes.
   size_t Count();

   /// A real number, of 8 bytes.
   double Real();

   /// @{
   /// Go on past @a number times @a each of them.
   void SkipInts(size_t number, size_t each = 1);
   void SkipCounts(size_t number, size_t each = 1);
   void SkipReals(size_t number, size_t each = 1);
   /// @}

private:
   const std::string text;
   size_t at = 0;

   [[noreturn]] void CutOff() const;
   std::string Found() const;
   void SkipBlanks();

   // In a binary, items of so many bytes; otherwise item by item with read.
   template <typename Read>
   void Skip(size_t number, size_t each, size_t bytes, Read read);

   template <typename T>
   T Bytes();

   // parse(from, &end) is strtod or its like.
   template <typename T, typename Parse>
   T Number(Parse parse);
};

} // namespace synovia
