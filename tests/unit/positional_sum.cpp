// ranks: 1
//
// The check sum of checkpoints: sums of parts add up, and any change shows.

#include "synovia/io/positional_sum.hpp"

#include <catch2/catch.hpp>

#include <string>

using synovia::PositionalSum;

namespace
{
std::uint64_t SumOf(const std::string &bytes, std::size_t begin = 0)
{
   PositionalSum sum;
   sum.Add(begin, bytes.data(), bytes.size());
   return sum.Value();
}
} // namespace

TEST_CASE("Sums of parts add up to that of the whole, whatever their order")
{
   const std::string bytes = "What was written is what is read, or else it "
                             "isn't one";
   REQUIRE(bytes.size() % 8 != 0);
   const std::uint64_t whole = SumOf(bytes);
   for (std::size_t cut = 0; cut < bytes.size(); cut += 8)
   {
      CAPTURE(cut);
      CHECK(SumOf(bytes.substr(cut), cut) + SumOf(bytes.substr(0, cut)) ==
            whole);
   }
   CHECK(SumOf("") == 0);
   // SplitMix64 of seed 0, first value: published with the generator.
   CHECK(SumOf(std::string(8, '\0')) == 0xe220a8397b1dcdafu);
}

TEST_CASE("A sum tells any change of bytes and of their places")
{
   const std::string bytes(64, 'a');
   const std::uint64_t sum = SumOf(bytes);
   for (std::size_t i = 0; i < bytes.size(); i++)
   {
      for (int bit = 0; bit < 8; bit++)
      {
         std::string changed = bytes;
         changed[i] = static_cast<char>(changed[i] ^ (1 << bit));
         CAPTURE(i, bit);
         CHECK(SumOf(changed) != sum);
      }
   }
   CHECK(SumOf(bytes, 8) != sum);
   CHECK(SumOf(bytes + std::string(8, '\0')) != sum);
   std::string swapped = "01234567abcdefgh";
   CHECK(SumOf("abcdefgh01234567") != SumOf(swapped));
}
