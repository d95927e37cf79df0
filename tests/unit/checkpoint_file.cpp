// ranks: 1 2
//
// Files of checkpoints: damaged ones, foreign ones, full disks. That a run goes
// on from one as if nothing had been is tested in parallel/checkpoint.cpp.

#include "support/boxes.hpp"
#include "support/temporary_directory.hpp"
#include "synovia/io/hdf5_columns.hpp"
#include "synovia/synovia.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <optional>
#include <sys/resource.h>

using namespace mfem;
using namespace synovia;

namespace
{
/// A column of four elements, or of another number, that is compressed.
class Column
{
public:
   explicit Column(int elements = 4, int order = 1, real_t height = 1.0)
      : mesh(MakeBox(Box(elements, height))), solid(0.5, 0.1), fluid(4e-3),
        problem(mesh, Space(order))
   {
      problem.SetMaterial("body", solid, fluid);
      problem.FixDisplacement("z0");
      problem.PrescribeDisplacement("z1", 2, Ramp(10.0, -0.01));
      problem.PrescribePressure("z1", 0.0);
      TimeOptions times;
      times.end = 10.0;
      stepper = std::make_unique<TimeStepper>(problem, times);
   }
   std::string Save(const std::string &directory)
   {
      return WriteCheckpoint(directory, problem, *stepper);
   }
   void Load(const std::string &file)
   {
      ReadCheckpoint(file, problem, *stepper);
   }
   void Step() { REQUIRE(stepper->Step().converged); }
   const TimeStepper &Stepper() const { return *stepper; }

private:
   static BoxOptions Box(int elements, real_t height)
   {
      BoxOptions box;
      box.nz = elements;
      box.size_z = height;
      return box;
   }
   static SpaceOptions Space(int order)
   {
      SpaceOptions space;
      space.order = order;
      return space;
   }

   NamedMesh mesh;
   IsotropicElastic solid;
   ConstantPermeability fluid;
   BiphasicProblem problem;
   std::unique_ptr<TimeStepper> stepper;
};

void Overwrite(const TemporaryDirectory &directory, const std::string &file,
               const std::string &text)
{
   directory.OnRootOnly([&]()
                        { std::ofstream(file, std::ios::binary) << text; });
}

std::vector<std::string> Files(const TemporaryDirectory &directory)
{
   MPI_Barrier(MPI_COMM_WORLD);
   std::vector<std::string> names;
   for (const auto &entry :
        std::filesystem::directory_iterator(directory.Path()))
   {
      names.push_back(entry.path().filename().string());
   }
   std::sort(names.begin(), names.end());
   MPI_Barrier(MPI_COMM_WORLD);
   return names;
}

/// No file of this process may grow beyond a size while this lives, as on a
/// disk that is full.
class FullDisk
{
public:
   explicit FullDisk(rlim_t bytes)
   {
      before_signal = std::signal(SIGXFSZ, SIG_IGN);
      getrlimit(RLIMIT_FSIZE, &before);
      rlimit limit = before;
      limit.rlim_cur = bytes;
      setrlimit(RLIMIT_FSIZE, &limit);
   }
   ~FullDisk()
   {
      setrlimit(RLIMIT_FSIZE, &before);
      std::signal(SIGXFSZ, before_signal);
   }

private:
   rlimit before;
   void (*before_signal)(int);
};
} // namespace

TEST_CASE("Any damage to a checkpoint is noticed, and nothing is changed")
{
   const TemporaryDirectory directory;
   Column column;
   column.Step();
   column.Step();
   const std::string file = column.Save(directory.Path());
   MPI_Barrier(MPI_COMM_WORLD);
   const std::string good = ReadText(file);
   REQUIRE(good.size() > 2000);

   Column other;
   const auto refused = [&](const std::string &text)
   {
      Overwrite(directory, file, text);
      std::string message;
      try
      {
         other.Load(file);
      }
      catch (const Error &error)
      {
         message = error.what();
      }
      CHECK(other.Stepper().Time() == 0.0);
      CHECK(FindCheckpoint(directory.Path(), MPI_COMM_WORLD).file.empty());
      return message;
   };
   const std::string damaged =
      "the checkpoint '" + file +
      "' is damaged: its contents are not those that were written";
   const std::string foreign =
      "'" + file + "' is no checkpoint of this version";
   CHECK(refused("") == foreign);
   CHECK(refused("t,dt\n1,2\n") == foreign);
   CHECK(refused("synovia checkpoint 1" + good.substr(20)) == foreign);
   for (const double part : {0.001, 0.1, 0.5, 0.9, 0.9999})
   {
      const auto length = static_cast<std::size_t>(part * good.size());
      CAPTURE(length);
      CHECK(refused(good.substr(0, length)) == damaged);
   }
   CHECK(refused(good + '\0') == damaged);
   for (std::size_t i = 25; i < good.size(); i += good.size() / 40)
   {
      CAPTURE(i);
      std::string bad = good;
      bad[i] = static_cast<char>(bad[i] ^ 4);
      CHECK(refused(bad) == damaged);
   }
   Overwrite(directory, file, good);
   other.Load(file);
   CHECK(other.Stepper().Time() == 2.0);
   CHECK(other.Stepper().Steps() == 2);
}

TEST_CASE("A checkpoint can be read by everything that reads HDF5")
{
   const TemporaryDirectory directory;
   Column column;
   column.Step();
   const std::string file = column.Save(directory.Path());
   CHECK(file == directory / "checkpoint_00000001.h5");
   MPI_Barrier(MPI_COMM_WORLD);
   CHECK(ReadHdf5Column(file, "numbers/time") == std::vector<double>{1.0});
   const std::vector<double> pressure = ReadHdf5Column(file, "fields/pressure");
   CHECK(pressure.size() == 20);
   CHECK(*std::max_element(pressure.begin(), pressure.end()) > 1e-6);
}

TEST_CASE("The newest checkpoints are kept, and the newest good one found")
{
   const TemporaryDirectory directory;
   CHECK(FindCheckpoint(directory.Path(), MPI_COMM_WORLD).file.empty());
   CHECK(FindCheckpoint(directory / "nowhere", MPI_COMM_WORLD).file.empty());
   directory.OnRootOnly(
      [&]()
      {
         // Of an earlier run, killed while it wrote; and files of others.
         for (const char *name :
              {"checkpoint_00000007.h5.new", "checkpoint_00000050.h5",
               "checkpoint_.h5", "checkpoint_1x.h5", "notes.txt"})
         {
            std::ofstream(directory / name) << name;
         }
      });
   Column column;
   std::string newest;
   for (int i = 0; i < 4; i++)
   {
      column.Step();
      newest = column.Save(directory.Path());
   }
   CHECK(Files(directory) ==
         std::vector<std::string>{"checkpoint_.h5", "checkpoint_00000003.h5",
                                  "checkpoint_00000004.h5", "checkpoint_1x.h5",
                                  "notes.txt"});
   CHECK(FindCheckpoint(directory.Path(), MPI_COMM_WORLD).file == newest);
   Overwrite(directory, newest, "nonsense");
   const FoundCheckpoint found =
      FindCheckpoint(directory.Path(), MPI_COMM_WORLD);
   CHECK(found.file == directory / "checkpoint_00000003.h5");
   REQUIRE(found.passed_over.size() == 1);
   CHECK(found.passed_over.front() ==
         "'" + newest + "' is no checkpoint of this version");
   DiscardCheckpointsAfter(directory.Path(), -1, MPI_COMM_WORLD);
   CHECK(Files(directory) == std::vector<std::string>{"checkpoint_.h5",
                                                      "checkpoint_1x.h5",
                                                      "notes.txt"});
}

TEST_CASE("A full disk is reported, and leaves the checkpoints that there are")
{
   const TemporaryDirectory directory;
   Column column;
   column.Step();
   const std::string before = column.Save(directory.Path());
   column.Step();
   for (const rlim_t room : {0, 100, 3000})
   {
      const FullDisk full(room);
      std::string message;
      try
      {
         column.Save(directory.Path());
      }
      catch (const Error &error)
      {
         message = error.what();
      }
      CAPTURE(room, message);
      CHECK((message.find("cannot write the checkpoint '") == 0 || room == 0));
      CHECK(message.find("File too large") != std::string::npos);
      CHECK(Files(directory) ==
            std::vector<std::string>{"checkpoint_00000001.h5"});
   }
   CHECK(FindCheckpoint(directory.Path(), MPI_COMM_WORLD).file == before);
   // The run goes on, and so do its checkpoints.
   column.Step();
   const std::string later = column.Save(directory.Path());
   CHECK(FindCheckpoint(directory.Path(), MPI_COMM_WORLD).file == later);
}

TEST_CASE("A checkpoint of another problem is refused")
{
   const TemporaryDirectory directory;
   Column column;
   column.Step();
   const std::string file = column.Save(directory.Path());
   MPI_Barrier(MPI_COMM_WORLD);
   const auto refused = [&](Column &other)
   {
      std::string message;
      try
      {
         other.Load(file);
      }
      catch (const Error &error)
      {
         message = error.what();
      }
      CHECK(other.Stepper().Time() == 0.0);
      return message;
   };
   const std::string begin =
      "the checkpoint '" + file + "' is one of another problem (";
   SECTION("of another mesh")
   {
      Column other(5);
      CHECK_THAT(
         refused(other),
         Catch::StartsWith(
            begin + "degrees of freedom: 80 there, 96 here; elements: 4 "
                    "there, 5 here; regions: body (4) there, body (5) here; "
                    "surfaces: x0 (4), ") &&
            Catch::Contains("; mean position of the elements: 0.5") &&
            Catch::EndsWith(" here); resume the case that wrote it, or start "
                            "anew"));
   }
   SECTION("of a mesh of another shape")
   {
      Column other(4, 1, 1.1);
      CHECK_THAT(refused(other),
                 Catch::StartsWith(begin + "mean position of the elements: "));
   }
   SECTION("of another order")
   {
      Column other(4, 2);
      CHECK_THAT(refused(other), Catch::Contains("order: 1 there, 2 here)"));
   }
   SECTION("where there is none")
   {
      Column other;
      std::string message;
      try
      {
         other.Load(directory / "none.h5");
      }
      catch (const Error &error)
      {
         message = error.what();
      }
      CHECK(message == "cannot read the checkpoint '" +
                          (directory / "none.h5") +
                          "': No such file or directory");
   }
}

TEST_CASE("A disk that is full for one rank is reported by all")
{
   const TemporaryDirectory directory;
   Column column;
   column.Step();
   const std::string before = column.Save(directory.Path());
   column.Step();
   const int last = Mpi::WorldSize() - 1;
   std::string message;
   {
      // The first rank has room for all but the values of fields, at least.
      std::optional<FullDisk> full;
      if (Mpi::WorldRank() == last)
      {
         full.emplace(last == 0 ? 3000 : 1);
      }
      try
      {
         column.Save(directory.Path());
      }
      catch (const Error &error)
      {
         message = error.what();
      }
   }
   CHECK(message == "cannot write the checkpoint '" + directory.Path() +
                       "/checkpoint_00000002.h5': File too large");
   CHECK(Files(directory) ==
         std::vector<std::string>{"checkpoint_00000001.h5"});
   CHECK(FindCheckpoint(directory.Path(), MPI_COMM_WORLD).file == before);
}
