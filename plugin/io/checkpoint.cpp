#include "io/checkpoint.hpp"
#include "general/error.hpp"
#include "general/text.hpp"
#include "io/canonical_order.hpp"
#include "io/checkpoint_file.hpp"
#include "io/output_directory.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <sstream>

namespace synovia
{

using namespace mfem;

namespace
{
constexpr const char *prefix = "checkpoint_";
constexpr const char *suffix = ".h5";

bool IsRoot(MPI_Comm comm)
{
   int rank = 0;
   MPI_Comm_rank(comm, &rank);
   return rank == 0;
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

/// Where the elements are: the mean of their centres, which weigh more the
/// later they come.
Point3 MeanPlace(const NamedMesh &named)
{
   ParMesh &mesh = const_cast<ParMesh &>(named.Get());
   double sums[4] = {0.0, 0.0, 0.0, 0.0};
   const real_t elements = mesh.GetGlobalNE();
   for (int i = 0; i < mesh.GetNE(); i++)
   {
      const real_t weight = 1.0 + named.SerialElements()[i] / elements;
      Vector centre;
      mesh.GetElementCenter(i, centre);
      for (int d = 0; d < 3; d++)
      {
         sums[d] += weight * centre[d];
      }
      sums[3] += weight;
   }
   MPI_Allreduce(MPI_IN_PLACE, sums, 4, MPI_DOUBLE, MPI_SUM, mesh.GetComm());
   return {{sums[0] / sums[3], sums[1] / sums[3], sums[2] / sums[3]}};
}

real_t Size(const NamedMesh &named)
{
   Vector low;
   Vector high;
   const_cast<ParMesh &>(named.Get()).GetBoundingBox(low, high);
   high -= low;
   return high.Normlinf();
}

/// What must be the same in the run that reads.
struct Fingerprint
{
   std::map<std::string, std::string> texts;
   Point3 place;
   real_t size;
};
constexpr const char *place_names[3] = {"mesh.x", "mesh.y", "mesh.z"};

Fingerprint TakeFingerprint(BiphasicProblem &problem)
{
   const ParMesh &mesh = problem.Mesh().Get();
   Fingerprint print;
   print.texts["elements"] = std::to_string(mesh.GetGlobalNE());
   print.texts["order"] = std::to_string(problem.Spaces().Order());
   print.texts["degrees of freedom"] =
      std::to_string(problem.Spaces().Displacement().GlobalTrueVSize() +
                     problem.Spaces().Pressure().GlobalTrueVSize());
   print.texts["materials"] = std::to_string(mesh.attributes.Size());
   std::string &pairs = print.texts["contact pairs"];
   for (const ContactPair *pair : problem.Operator().Pairs())
   {
      pairs += (pairs.empty() ? "" : ", ") + pair->Name();
   }
   if (pairs.empty())
   {
      pairs = "none";
   }
   print.place = MeanPlace(problem.Mesh());
   print.size = Size(problem.Mesh());
   return print;
}

/// How the problem of a checkpoint differs from this one, or nothing.
std::string Compare(const CheckpointContents &contents, const Fingerprint &mine)
{
   // Sums over the ranks differ by round-off.
   constexpr real_t tolerance = 1e-8;
   std::string differences;
   const auto add = [&](const std::string &name, const std::string &theirs,
                        const std::string &ours)
   {
      differences += (differences.empty() ? "" : "; ") + name + ": " + theirs +
                     " there, " + ours + " here";
   };
   for (const auto &[name, value] : mine.texts)
   {
      const auto theirs = contents.texts.find(name);
      const std::string other =
         theirs == contents.texts.end() ? "unknown" : theirs->second;
      if (other != value)
      {
         add(name, other, value);
      }
   }
   for (int d = 0; d < 3; d++)
   {
      const auto theirs = contents.numbers.find(place_names[d]);
      if (theirs == contents.numbers.end() ||
          std::abs(theirs->second - mine.place[d]) > tolerance * mine.size)
      {
         add("mean position of the elements", "another", ToText(mine.place[d]));
         break;
      }
   }
   return differences;
}

struct Candidate
{
   long number;
   std::filesystem::path path;
};

/// Number of the checkpoint of this name, or -1.
long NumberOf(const std::string &name)
{
   const std::string begin(prefix);
   const std::string end(suffix);
   if (name.size() <= begin.size() + end.size() ||
       name.compare(0, begin.size(), begin) != 0 ||
       name.compare(name.size() - end.size(), end.size(), end) != 0)
   {
      return -1;
   }
   const std::string digits =
      name.substr(begin.size(), name.size() - begin.size() - end.size());
   const bool number =
      digits.find_first_not_of("0123456789") == std::string::npos &&
      digits.size() < 18;
   return number ? std::stol(digits) : -1;
}

/// The checkpoints there are, newest first.
std::vector<Candidate> List(const std::string &directory)
{
   std::vector<Candidate> candidates;
   std::error_code error;
   for (std::filesystem::directory_iterator entry(directory, error), end;
        !error && entry != end; entry.increment(error))
   {
      const long number = NumberOf(entry->path().filename().string());
      if (number >= 0)
      {
         candidates.push_back({number, entry->path()});
      }
   }
   std::sort(candidates.begin(), candidates.end(),
             [](const Candidate &a, const Candidate &b)
             { return a.number > b.number; });
   return candidates;
}

/// Removes those that are not wanted any more, after @a newest was written, and
/// what a killed run left unfinished.
void Tidy(const std::string &directory, int newest, int keep)
{
   std::error_code ignored;
   int kept = 0;
   for (const Candidate &candidate : List(directory))
   {
      const bool wanted = candidate.number <= newest && kept < keep;
      kept += wanted ? 1 : 0;
      if (!wanted)
      {
         std::filesystem::remove(candidate.path, ignored);
      }
   }
   std::vector<std::filesystem::path> unfinished;
   for (std::filesystem::directory_iterator entry(directory, ignored), end;
        !ignored && entry != end; entry.increment(ignored))
   {
      if (entry->path().extension() == ".new" &&
          NumberOf(entry->path().stem().string()) >= 0)
      {
         unfinished.push_back(entry->path());
      }
   }
   for (const std::filesystem::path &path : unfinished)
   {
      std::filesystem::remove(path, ignored);
   }
}

std::string FileName(const std::string &directory, int steps)
{
   char digits[32];
   std::snprintf(digits, sizeof(digits), "%08d", steps);
   return directory + "/" + prefix + digits + suffix;
}

/// Runs @a work on rank 0; throws what it throws on all ranks.
template <typename Work>
void OnRoot(MPI_Comm comm, Work work)
{
   std::string message;
   if (IsRoot(comm))
   {
      try
      {
         work();
      }
      catch (const std::exception &error)
      {
         message = error.what();
      }
   }
   ThrowIfAny(comm, message);
}
} // namespace

std::string WriteCheckpoint(const std::string &directory,
                            BiphasicProblem &problem, TimeStepper &stepper,
                            int keep)
{
   MPI_Comm comm = problem.Spaces().GetComm();
   MakeOutputDirectory(directory, comm);
   CheckpointContents contents;
   const Fingerprint print = TakeFingerprint(problem);
   contents.texts = print.texts;
   for (int d = 0; d < 3; d++)
   {
      contents.numbers[place_names[d]] = print.place[d];
   }
   Orders orders(problem.Mesh());
   Writing archive(orders, contents);
   stepper.Archive(archive);
   const std::string file = FileName(directory, stepper.Steps());
   OnRoot(comm,
          [&]()
          {
             WriteCheckpointFile(file, contents);
             Tidy(directory, stepper.Steps(), std::max(1, keep));
          });
   return file;
}

void ReadCheckpoint(const std::string &file, BiphasicProblem &problem,
                    TimeStepper &stepper)
{
   MPI_Comm comm = problem.Spaces().GetComm();
   const Fingerprint mine = TakeFingerprint(problem);
   CheckpointContents contents;
   OnRoot(comm,
          [&]()
          {
             contents = ReadCheckpointFile(file);
             const std::string differences = Compare(contents, mine);
             if (!differences.empty())
             {
                throw std::runtime_error(
                   "the checkpoint '" + file + "' is one of another problem (" +
                   differences +
                   "); resume the case that wrote it, or start "
                   "anew");
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

FoundCheckpoint FindCheckpoint(const std::string &directory, MPI_Comm comm)
{
   // One line each: the file first, then those passed over.
   std::string lines;
   if (IsRoot(comm))
   {
      std::string passed_over;
      std::string found;
      for (const Candidate &candidate : List(directory))
      {
         try
         {
            VerifyCheckpointFile(candidate.path.string());
            found = candidate.path.string();
            break;
         }
         catch (const std::exception &error)
         {
            passed_over += "\n" + std::string(error.what());
         }
      }
      lines = found + passed_over;
   }
   int length = static_cast<int>(lines.size());
   MPI_Bcast(&length, 1, MPI_INT, 0, comm);
   lines.resize(length);
   MPI_Bcast(lines.data(), length, MPI_CHAR, 0, comm);
   FoundCheckpoint result;
   std::istringstream stream(lines);
   std::getline(stream, result.file);
   for (std::string line; std::getline(stream, line);)
   {
      result.passed_over.push_back(line);
   }
   return result;
}

void DiscardCheckpoints(const std::string &directory, MPI_Comm comm)
{
   if (IsRoot(comm))
   {
      Tidy(directory, -1, 0);
   }
   MPI_Barrier(comm);
}

} // namespace synovia
