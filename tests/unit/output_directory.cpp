// ranks: 1 2 3

#include "synovia/io/output_directory.hpp"
#include "support/temporary_directory.hpp"
#include "synovia/general/error.hpp"

#include <catch2/catch.hpp>

#include <filesystem>
#include <fstream>

using namespace synovia;
using Catch::Matchers::Contains;

TEST_CASE("An output directory is made with those above it", "[io]")
{
   const TemporaryDirectory temp;
   const std::string path = temp / "a/b/c";
   MakeOutputDirectory(path, MPI_COMM_WORLD);
   CHECK(std::filesystem::is_directory(path));
   CHECK(std::filesystem::is_empty(path));

   // One that is there will do, and keeps what is in it.
   temp.OnRootOnly([&]() { std::ofstream(path + "/kept") << "kept"; });
   CHECK_NOTHROW(MakeOutputDirectory(path, MPI_COMM_WORLD));
   CHECK(ReadText(path + "/kept") == "kept");
}

TEST_CASE("An impossible output directory is an error on all ranks", "[io]")
{
   const TemporaryDirectory temp;
   temp.OnRootOnly([&]() { std::ofstream(temp / "file") << "a file"; });
   REQUIRE_THROWS_WITH(MakeOutputDirectory(temp / "file/sub", MPI_COMM_WORLD),
                       Contains("file/sub': Not a directory"));
   REQUIRE_THROWS_AS(MakeOutputDirectory(temp / "file", MPI_COMM_WORLD), Error);
   // Nobody, not even root, makes files there.
   REQUIRE_THROWS_WITH(MakeOutputDirectory("/proc", MPI_COMM_WORLD),
                       Contains("cannot write into the output directory "
                                "'/proc': No such file"));
}
