#pragma once

#include "synovia/io/checkpoint_contents.hpp"

#include <vector>

namespace synovia
{

/// Where in a checkpoint's HDF5 file everything is, so that each process can
/// write its values of the fields. For one process.
struct CheckpointLayout
{
   /// Makes it of what is to be in it. Throws std::runtime_error if HDF5 can't.
   explicit CheckpointLayout(const CheckpointContents &contents);

   struct Piece
   {
      std::size_t begin;
      std::vector<char> bytes;
   };
   /// All bytes that are no values of fields.
   std::vector<Piece> pieces;
   /// Where the values of each field begin, multiples of 8.
   std::map<std::string, std::size_t> field_begins;
   /// Of the file.
   std::size_t size = 0;
};

} // namespace synovia
