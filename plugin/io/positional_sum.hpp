#pragma once

#include <algorithm>
#include <cstdint>
#include <cstring>

namespace synovia
{

/// A check sum of words of eight bytes and of where they are: those of the
/// parts of a file add up to that of the whole, modulo 2^64.
class PositionalSum
{
public:
   /// Adds @a count bytes that begin at @a begin, a multiple of 8. A last word
   /// that is not whole counts as if zeros followed.
   void Add(std::size_t begin, const char *bytes, std::size_t count)
   {
      for (std::size_t i = 0; i < count; i += sizeof(std::uint64_t))
      {
         std::uint64_t word = 0;
         std::memcpy(&word, bytes + i, std::min(sizeof(word), count - i));
         sum += Mix(word, (begin + i) / sizeof(word));
      }
   }
   std::uint64_t Value() const { return sum; }

private:
   /// The finalizer of SplitMix64 (Steele, Lea & Flood, Proc OOPSLA 2014).
   static std::uint64_t Mix(std::uint64_t word, std::uint64_t place)
   {
      std::uint64_t mixed = word + (place + 1) * 0x9e3779b97f4a7c15u;
      mixed = (mixed ^ (mixed >> 30)) * 0xbf58476d1ce4e5b9u;
      mixed = (mixed ^ (mixed >> 27)) * 0x94d049bb133111ebu;
      return mixed ^ (mixed >> 31);
   }

   std::uint64_t sum = 0;
};

} // namespace synovia
