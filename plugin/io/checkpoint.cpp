#include "synovia/io/checkpoint.hpp"
#include "synovia/general/root_rank.hpp"
#include "synovia/io/canonical_order.hpp"
#include "synovia/io/checkpoint_directory.hpp"
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

class Writing : public StateArchive
{
public:
   Writing(Orders &orders_, CheckpointContents &contents_)
      : orders(orders_), contents(contents_)
   {
   }
   bool Reads() const override { return false; }
   void Number(const std::string &name, real_t &value) override
   {
      contents.numbers[name] = value;
   }
   void Field(const std::string &name, ParFiniteElementSpace &space,
              Vector &true_dofs) override
   {
      contents.fields[name] = orders.Of(space).Gather(true_dofs);
   }

private:
   Orders &orders;
   CheckpointContents &contents;
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
      if (contents.numbers.count(name) == 0)
      {
         missing = name;
      }
   }
   void Field(const std::string &name, ParFiniteElementSpace &space,
              Vector &) override
   {
      const auto field = contents.fields.find(name);
      if (field == contents.fields.end() ||
          static_cast<HYPRE_BigInt>(field->second.size()) !=
             space.GlobalTrueVSize())
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
   Reading(Orders &orders_, const CheckpointContents &contents_, MPI_Comm comm_)
      : orders(orders_), contents(contents_), comm(comm_)
   {
   }
   bool Reads() const override { return true; }
   void Number(const std::string &name, real_t &value) override
   {
      double number = IsRoot(comm) ? contents.numbers.at(name) : 0.0;
      MPI_Bcast(&number, 1, MPI_DOUBLE, 0, comm);
      value = number;
   }
   void Field(const std::string &name, ParFiniteElementSpace &space,
              Vector &true_dofs) override
   {
      static const std::vector<double> nothing;
      orders.Of(space).Scatter(
         IsRoot(comm) ? contents.fields.at(name) : nothing, true_dofs);
   }

private:
   Orders &orders;
   const CheckpointContents &contents;
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
   Orders orders(problem.Mesh());
   Writing archive(orders, contents);
   stepper.Archive(archive);
   const std::string file = CheckpointName(directory, stepper.Steps());
   OnRoot(comm,
          [&]()
          {
             WriteCheckpointFile(file, contents);
             TidyCheckpoints(directory, stepper.Steps(), std::max(1, keep));
          });
   return file;
}

Checkpoint::Checkpoint(const std::string &file_, MPI_Comm comm_)
   : file(file_), comm(comm_)
{
   OnRoot(comm,
          [&]()
          {
             contents = ReadCheckpointFile(file);
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
   Orders orders(problem.Mesh());
   Reading archive(orders, contents, comm);
   stepper.Archive(archive);
}

void ReadCheckpoint(const std::string &file, BiphasicProblem &problem,
                    TimeStepper &stepper)
{
   Checkpoint(file, problem.Spaces().GetComm()).Restore(problem, stepper);
}

} // namespace synovia
