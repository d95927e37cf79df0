#pragma once

#include "mfem.hpp"

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace synovia
{

/// Rows of named numbers, one for each accepted step, in history.csv and
/// history.h5 of the output directory.
///
/// The CSV has a line of names and 15 significant digits; the HDF5 file has a
/// dataset of doubles for each column. Both are written out after every row, so
/// a killed run loses no row that Add() returned from.
class History
{
public:
   /// Names and values in the order of the columns, time first by custom.
   using Row = std::vector<std::pair<std::string, mfem::real_t>>;

   /// Makes the directory where needed and starts a history in place of one
   /// that is there. With @a keep_until rows of that one stay whose "t" is not
   /// later, and the rows to come follow them, as a restart needs.
   ///
   /// Collective over @a comm; rank 0 writes. Throws Error on all ranks if the
   /// files can't be written, or those to be continued can't be read.
   History(const std::string &directory, MPI_Comm comm,
           std::optional<mfem::real_t> keep_until = std::nullopt);
   ~History();

   /// Adds a row. The first one names the columns; the others must have the
   /// same. Collective, but only the row of rank 0 counts. Throws Error on all
   /// ranks if names differ or are unfit (comma, quote, slash, repeated), or if
   /// the files can't be written, for one because the disk is full.
   void Add(const Row &row);

   /// Adds a row that may have other columns than those before: columns that
   /// are new are 0 in the rows before, those that it lacks are 0 in it.
   void AddVarying(const Row &row);

   /// How many rows there are, kept ones included.
   int Rows() const { return rows; }

private:
   class Files; // rank 0 only

   MPI_Comm comm;
   int rows = 0;
   std::unique_ptr<Files> files;
};

} // namespace synovia
