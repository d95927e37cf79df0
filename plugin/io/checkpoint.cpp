#include "synovia/io/checkpoint.hpp"
#include "synovia/general/root_rank.hpp"
#include "synovia/io/canonical_order.hpp"
#include "synovia/io/checkpoint_directory.hpp"
#include "synovia/io/checkpoint_file.hpp"
#include "synovia/io/checkpoint_writer.hpp"
#include "synovia/io/output_directory.hpp"
#include "synovia/io/problem_fingerprint.hpp"

#include <algorithm>
#include <memory>
#include <stdexcept>

namespace synovia
{

using namespace mfem;

namespace
{
// Names of what a checkpoint holds besides what the stepper lists.
constexpr const char *setup_name = "case";

/// Of a name of what is archived: a slash would be a group of HDF5.
std::string InFile(std::string name)
{
   std::replace(name.begin(), name.end(), '/', '|');
   return name;
}

/// The orders of the spaces of a problem.
class Orders
{
public:
   explicit Orders(const NamedMesh &mesh_) : mesh(mesh_) {}

   /// Collective at the first call for a space.
   const CanonicalOrder &Of(const ParFiniteElementSpace &space)
   {
      std::unique_ptr<CanonicalOrder> &order = orders[&space];
      if (!order)
      {
         order = std::make_unique<CanonicalOrder>(space, mesh.SerialElements());
      }
      return *order;
   }

private:
   const NamedMesh &mesh;
   std::map<const ParFiniteElementSpace *, std::unique_ptr<CanonicalOrder>>
      orders;
};

/// Lists what there is to write.
class Listing : public StateArchive
{
public:
   explicit Listing(CheckpointContents &contents_) : contents(contents_) {}
   bool Reads() const override { return false; }
   void Number(const std::string &name, real_t &value) override
   {
      contents.numbers[InFile(name)] = value;
   }
   void Field(const std::string &name, ParFiniteElementSpace &space,
              Vector &) override
   {
      contents.field_sizes[InFile(name)] = space.GlobalTrueVSize();
   }

private:
   CheckpointContents &contents;
};

class Writing : public StateArchive
{
public:
   Writing(Orders &orders_, CheckpointWriter &file_)
      : orders(orders_), file(file_)
   {
   }
   bool Reads() const override { return false; }
   void Number(const std::string &, real_t &) override {}
   void Field(const std::string &name, ParFiniteElementSpace &space,
              Vector &true_dofs) override
   {
      const CanonicalOrder &order = orders.Of(space);
      file.Write(InFile(name), order.Begin(), order.ToOrder(true_dofs));
   }

private:
   Orders &orders;
   CheckpointWriter &file;
};

/// Says what a checkpoint lacks of what is going to be read. Rank 0 knows.
class Checking : public StateArchive
{
public:
   explicit Checking(const CheckpointContents &contents_) : contents(contents_)
   {
   }
   bool Reads() const override { return false; }
   void Number(const std::string &name, real_t &) override
   {
      if (contents.numbers.count(InFile(name)) == 0)
      {
         missing = name;
      }
   }
   void Field(const std::string &name, ParFiniteElementSpace &space,
              Vector &) override
   {
      const auto size = contents.field_sizes.find(InFile(name));
      if (size == contents.field_sizes.end() ||
          static_cast<HYPRE_BigInt>(size->second) != space.GlobalTrueVSize())
      {
         missing = name;
      }
   }
   const std::string &Missing() const { return missing; }

private:
   const CheckpointContents &contents;
   std::string missing;
};

class Reading : public StateArchive
{
public:
   Reading(Orders &orders_, const CheckpointContents &contents_,
           const CheckpointFields &fields_, MPI_Comm comm_)
      : orders(orders_), contents(contents_), fields(fields_), comm(comm_)
   {
   }
   bool Reads() const override { return true; }
   void Number(const std::string &name, real_t &value) override
   {
      double number = IsRoot(comm) ? contents.numbers.at(InFile(name)) : 0.0;
      MPI_Bcast(&number, 1, MPI_DOUBLE, 0, comm);
      value = number;
   }
   void Field(const std::string &name, ParFiniteElementSpace &space,
              Vector &true_dofs) override
   {
      const CanonicalOrder &order = orders.Of(space);
      std::vector<double> part;
      OnEachRank(
         comm, [&]()
         { part = fields.Read(InFile(name), order.Begin(), order.Size()); });
      order.FromOrder(part, true_dofs);
   }

private:
   Orders &orders;
   const CheckpointContents &contents;
   const CheckpointFields &fields;
   MPI_Comm comm;
};
} // namespace

std::string WriteCheckpoint(const std::string &directory,
                            BiphasicProblem &problem, TimeStepper &stepper,
                            const std::string &setup, int keep)
{
   MPI_Comm comm = problem.Spaces().GetComm();
   MakeOutputDirectory(directory, comm);
   CheckpointContents contents;
   if (!setup.empty())
   {
      contents.texts[setup_name] = setup;
   }
   AddFingerprint(problem, contents);
   Listing listing(contents);
   stepper.Archive(listing);
   const std::string name = CheckpointName(directory, stepper.Steps());
   CheckpointWriter file(name, contents, comm);
   Orders orders(problem.Mesh());
   Writing archive(orders, file);
   stepper.Archive(archive);
   file.Finish();
   OnRoot(comm, [&]()
          { TidyCheckpoints(directory, stepper.Steps(), std::max(1, keep)); });
   return name;
}

Checkpoint::Checkpoint(const std::string &file_, MPI_Comm comm_)
   : file(file_), comm(comm_)
{
   VerifyCheckpointFile(file, comm);
   OnRoot(comm,
          [&]()
          {
             contents = ReadCheckpointContents(file);
             setup = contents.texts[setup_name];
             if (contents.numbers.count("time") == 0 ||
                 contents.numbers.count("steps") == 0)
             {
                throw std::runtime_error("the checkpoint '" + file +
                                         "' does not say what time it is of");
             }
             time = contents.numbers["time"];
             steps = static_cast<int>(contents.numbers["steps"]);
          });
   Broadcast(setup, comm);
   MPI_Bcast(&time, 1, MPITypeMap<real_t>::mpi_type, 0, comm);
   MPI_Bcast(&steps, 1, MPI_INT, 0, comm);
}

void Checkpoint::Restore(BiphasicProblem &problem, TimeStepper &stepper) const
{
   CheckpointContents mine;
   AddFingerprint(problem, mine);
   OnRoot(
      comm,
      [&]()
      {
         const std::string differences = CompareFingerprints(contents, mine);
         if (!differences.empty())
         {
            throw std::runtime_error(
               "the checkpoint '" + file + "' is one of another problem (" +
               differences + "); resume the case that wrote it, or start anew");
         }
      });
   Checking checking(contents);
   stepper.Archive(checking);
   ThrowIfAny(comm, IsRoot(comm) && !checking.Missing().empty()
                       ? "the checkpoint '" + file + "' lacks \"" +
                            checking.Missing() + "\", or has it in another size"
                       : "");
   std::unique_ptr<CheckpointFields> fields;
   OnEachRank(comm,
              [&]() { fields = std::make_unique<CheckpointFields>(file); });
   Orders orders(problem.Mesh());
   Reading archive(orders, contents, *fields, comm);
   stepper.Archive(archive);
}

void ReadCheckpoint(const std::string &file, BiphasicProblem &problem,
                    TimeStepper &stepper)
{
   Checkpoint(file, problem.Spaces().GetComm()).Restore(problem, stepper);
}

} // namespace synovia
