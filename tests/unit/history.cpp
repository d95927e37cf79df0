// ranks: 1 2 3

#include "synovia/io/history.hpp"
#include "support/temporary_directory.hpp"
#include "synovia/general/error.hpp"
#include "synovia/io/hdf5_columns.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <filesystem>
#include <fstream>

using namespace synovia;
using Catch::Matchers::Contains;

namespace
{
using Values = std::vector<double>;

History::Row MakeRow(double t, double force)
{
   return {{"t", t}, {"reaction.indenter_top.z", force}};
}

void AddRows(History &history, int from, int to)
{
   for (int i = from; i <= to; i++)
   {
      history.Add(MakeRow(i, -0.1 * i));
   }
}
} // namespace

TEST_CASE("A history is the same in both files", "[io]")
{
   const TemporaryDirectory temp;
   {
      History history(temp / "out", MPI_COMM_WORLD);
      history.Add(MakeRow(0.1, -1.0 / 3.0));
      history.Add(MakeRow(1e-20, 0.0));
      CHECK(history.Rows() == 2);
   }
   MPI_Barrier(MPI_COMM_WORLD);
   CHECK(ReadText(temp / "out/history.csv") == "t,reaction.indenter_top.z\n"
                                               "0.1,-0.333333333333333\n"
                                               "1e-20,0\n");
   CHECK(ReadHdf5Column(temp / "out/history.h5", "t") == Values{0.1, 1e-20});
   CHECK(ReadHdf5Column(temp / "out/history.h5", "reaction.indenter_top.z") ==
         Values{-1.0 / 3.0, 0.0});
}

TEST_CASE("A killed run leaves all rows but the one in work", "[io]")
{
   const TemporaryDirectory temp;
   History history(temp.Path(), MPI_COMM_WORLD);
   // More than a chunk of the HDF5 datasets.
   AddRows(history, 1, 1100);
   // The files are readable, and what is in them is what a kill would leave.
   CHECK(ReadHdf5Column(temp / "history.h5", "t").size() == 1100);
   temp.OnRootOnly(
      [&]()
      {
         std::filesystem::copy_file(temp / "history.h5", temp / "left.h5");
         std::filesystem::copy_file(temp / "history.csv", temp / "left.csv");
      });
   const Values t = ReadHdf5Column(temp / "left.h5", "t");
   REQUIRE(t.size() == 1100);
   CHECK(t.back() == 1100.0);
   CHECK_THAT(ReadText(temp / "left.csv"), Catch::EndsWith("\n1100,-110\n"));
}

TEST_CASE("A row is appended to the HDF5 file where it is", "[io]")
{
   const TemporaryDirectory temp;
   History history(temp.Path(), MPI_COMM_WORLD);
   AddRows(history, 1, 3);
   temp.OnRootOnly(
      [&]() {
         std::filesystem::create_hard_link(temp / "history.h5",
                                           temp / "same.h5");
      });
   AddRows(history, 4, 512);
   CHECK(ReadHdf5Column(temp / "same.h5", "t").size() == 512);
   // Another chunk: another file, and the old one stays whole.
   AddRows(history, 513, 513);
   CHECK(ReadHdf5Column(temp / "same.h5", "t").size() == 512);
   CHECK(ReadHdf5Column(temp / "history.h5", "t").size() == 513);
}

// A kill may come between any two blocks of 512 bytes, the last one first.
TEST_CASE("Whatever part of a row is written, those of before are there",
          "[io]")
{
   const TemporaryDirectory temp;
   History history(temp.Path(), MPI_COMM_WORLD);
   AddRows(history, 1, 600);
   const std::string before = ReadText(temp / "history.h5");
   // Rank 0 writes while others may still read.
   MPI_Barrier(MPI_COMM_WORLD);
   AddRows(history, 601, 601);
   const std::string after = ReadText(temp / "history.h5");
   REQUIRE(before.size() == after.size());
   std::string part = before;
   int written = 0;
   for (std::size_t i = (before.size() + 511) / 512; i-- > 0;)
   {
      if (before.compare(512 * i, 512, after, 512 * i, 512) == 0)
      {
         continue;
      }
      part.replace(512 * i, 512, after, 512 * i, 512);
      written++;
      CAPTURE(i, written);
      const std::string file = temp.Write("part.h5", part);
      for (const std::string column : {"t", "reaction.indenter_top.z"})
      {
         const Values values = ReadHdf5Column(file, column);
         REQUIRE((values.size() == 600 || values.size() == 601));
         const double factor = column == "t" ? 1.0 : -0.1;
         CHECK(values[0] == factor);
         CHECK(values[599] == Approx(600 * factor));
         CHECK(values.back() == Approx(factor * values.size()));
      }
   }
   CHECK(written >= 2);
   CHECK(part == after);
}

TEST_CASE("A new history replaces an old one, before its first row", "[io]")
{
   const TemporaryDirectory temp;
   {
      History history(temp.Path(), MPI_COMM_WORLD);
      AddRows(history, 1, 3);
   }
   const History history(temp.Path(), MPI_COMM_WORLD);
   CHECK_FALSE(std::filesystem::exists(temp / "history.csv"));
   CHECK_FALSE(std::filesystem::exists(temp / "history.h5"));
}

TEST_CASE("A restart keeps the rows up to its time and goes on", "[io]")
{
   const TemporaryDirectory temp;
   {
      History history(temp.Path(), MPI_COMM_WORLD);
      AddRows(history, 1, 9);
   }
   temp.OnRootOnly(
      [&]()
      {
         // A killed run may also leave half a line.
         std::ofstream(temp / "history.csv", std::ios::app) << "5";
      });
   {
      History history(temp.Path(), MPI_COMM_WORLD, 6.0);
      CHECK(history.Rows() == 6);
      AddRows(history, 7, 8);
      CHECK(history.Rows() == 8);
   }
   MPI_Barrier(MPI_COMM_WORLD);
   CHECK(ReadHdf5Column(temp / "history.h5", "t") ==
         Values{1, 2, 3, 4, 5, 6, 7, 8});
   CHECK_THAT(ReadText(temp / "history.csv"),
              Contains("6,-0.6\n7,-0.7\n8,-0.8\n"));
   CHECK_FALSE(std::filesystem::exists(temp / "history.csv.new"));
}

TEST_CASE("There must be a history to continue, with times", "[io]")
{
   const TemporaryDirectory temp;
   REQUIRE_THROWS_WITH(History(temp.Path(), MPI_COMM_WORLD, 1.0),
                       Contains("history.csv', the history to continue"));
   temp.OnRootOnly([&]() { std::ofstream(temp / "history.csv") << "a,b\n"; });
   REQUIRE_THROWS_WITH(History(temp.Path(), MPI_COMM_WORLD, 1.0),
                       Contains("has no column 't'"));
}

TEST_CASE("Rows must have the columns of the first one", "[io]")
{
   const TemporaryDirectory temp;
   History history(temp.Path(), MPI_COMM_WORLD);
   history.Add(MakeRow(1.0, 2.0));
   REQUIRE_THROWS_WITH(history.Add({{"t", 2.0}, {"dt", 1.0}}),
                       Contains("'dt' where the history has "
                                "'reaction.indenter_top.z'"));
   REQUIRE_THROWS_WITH(history.Add({{"t", 2.0}}),
                       Contains("no more columns where the history has"));
   CHECK(history.Rows() == 1);
   CHECK_NOTHROW(history.Add(MakeRow(2.0, 3.0)));
}

TEST_CASE("Names that a file can't hold are refused", "[io]")
{
   const TemporaryDirectory temp;
   History history(temp.Path(), MPI_COMM_WORLD);
   for (const std::string name : {"", "a,b", "a/b", "a\"b", "a\nb"})
   {
      REQUIRE_THROWS_WITH(history.Add({{"t", 0.0}, {name, 1.0}}),
                          Contains("'" + name + "' cannot name a column"));
   }
   REQUIRE_THROWS_WITH(history.Add({{"t", 0.0}, {"t", 1.0}}),
                       Contains("two columns 't'"));
}

TEST_CASE("A history that can't be written is an error on all ranks", "[io]")
{
   const TemporaryDirectory temp;
   temp.OnRootOnly([&]() { std::ofstream(temp / "file") << "a file"; });
   REQUIRE_THROWS_WITH(History(temp / "file/out", MPI_COMM_WORLD),
                       Contains("file/out"));

   // /dev/full is a disk without space. The HDF5 file is written anew, beside
   // the old one, for every row.
   for (const std::string file : {"history.csv", "history.h5.new"})
   {
      History history(temp / file + ".d", MPI_COMM_WORLD);
      temp.OnRootOnly(
         [&]() {
            std::filesystem::create_symlink("/dev/full",
                                            temp / file + ".d/" + file);
         });
      REQUIRE_THROWS_WITH(AddRows(history, 1, 2),
                          Contains("cannot write '" + (temp / file) + ".d/h") &&
                             Contains("No space left on device"));
   }
}

TEST_CASE("Columns may come and go, and are 0 where there is nothing", "[io]")
{
   const TemporaryDirectory temp;
   History history(temp.Path(), MPI_COMM_WORLD);
   history.AddVarying({{"t", 1.0}, {"force", 1.0 / 3.0}});
   history.AddVarying({{"t", 2.0}, {"area", 4.0}});
   history.AddVarying({{"t", 3.0}, {"force", 6.0}, {"area", 8.0}});
   CHECK(history.Rows() == 3);
   CHECK(ReadText(temp / "history.csv") == "t,force,area\n"
                                           "1,0.333333333333333,0\n"
                                           "2,0,4\n"
                                           "3,6,8\n");
   CHECK(ReadHdf5Column(temp / "history.h5", "area") == Values{0.0, 4.0, 8.0});
   CHECK(ReadHdf5Column(temp / "history.h5", "force").size() == 3);
   // Add() is still strict.
   CHECK_THROWS_WITH(history.Add({{"t", 4.0}, {"force", 1.0}}),
                     Contains("has no more columns"));
}
