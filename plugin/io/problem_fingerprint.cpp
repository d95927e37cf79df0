#include "synovia/io/problem_fingerprint.hpp"
#include "synovia/general/point3.hpp"
#include "synovia/general/text.hpp"

#include <algorithm>
#include <cmath>

namespace synovia
{

using namespace mfem;

namespace
{
// The mesh by numbers of which sums over the ranks differ by round-off.
constexpr real_t tolerance = 1e-8;
const char *const place_names[3] = {"mesh.x", "mesh.y", "mesh.z"};
const char *const low_names[3] = {"mesh.low.x", "mesh.low.y", "mesh.low.z"};
const char *const high_names[3] = {"mesh.high.x", "mesh.high.y", "mesh.high.z"};

/// Where the elements are: the mean of their centers, which weigh more the
/// later they come.
Point3 MeanPlace(const NamedMesh &named)
{
   ParMesh &mesh = const_cast<ParMesh &>(named.Get());
   double sums[4] = {0.0, 0.0, 0.0, 0.0};
   const real_t elements = mesh.GetGlobalNE();
   for (int i = 0; i < mesh.GetNE(); i++)
   {
      const real_t weight = 1.0 + named.SerialElements()[i] / elements;
      Vector center;
      mesh.GetElementCenter(i, center);
      for (int d = 0; d < 3; d++)
      {
         sums[d] += weight * center[d];
      }
      sums[3] += weight;
   }
   MPI_Allreduce(MPI_IN_PLACE, sums, 4, MPI_DOUBLE, MPI_SUM, mesh.GetComm());
   return {{sums[0] / sums[3], sums[1] / sums[3], sums[2] / sums[3]}};
}

/// Names with how many elements or faces each has. @a counts are by attribute,
/// of this rank.
std::string GroupText(const NameTable &groups, std::vector<long long> counts,
                      MPI_Comm comm)
{
   // Ranks need not have all attributes, but know them.
   MPI_Allreduce(MPI_IN_PLACE, counts.data(), static_cast<int>(counts.size()),
                 MPI_LONG_LONG, MPI_SUM, comm);
   std::string text;
   for (const auto &[name, attributes] : groups)
   {
      long long count = 0;
      for (const int attribute : attributes)
      {
         count += counts[attribute];
      }
      text +=
         (text.empty() ? "" : ", ") + name + " (" + std::to_string(count) + ")";
   }
   return text.empty() ? "none" : text;
}

/// How many of @a size elements or faces have each attribute.
template <typename AttributeOf>
std::vector<long long> Count(int size, int largest, AttributeOf attribute_of)
{
   std::vector<long long> counts(largest + 1, 0);
   for (int i = 0; i < size; i++)
   {
      counts[attribute_of(i)]++;
   }
   return counts;
}

void AddMesh(const NamedMesh &named, CheckpointContents &contents)
{
   ParMesh &mesh = const_cast<ParMesh &>(named.Get());
   contents.texts["elements"] = std::to_string(mesh.GetGlobalNE());
   contents.texts["materials"] = std::to_string(mesh.attributes.Size());
   contents.texts["regions"] =
      GroupText(named.Regions(),
                Count(mesh.GetNE(), mesh.attributes.Max(),
                      [&](int i) { return mesh.GetAttribute(i); }),
                named.GetComm());
   const int largest =
      mesh.bdr_attributes.IsEmpty() ? 0 : mesh.bdr_attributes.Max();
   contents.texts["surfaces"] =
      GroupText(named.Boundaries(),
                Count(mesh.GetNBE(), largest,
                      [&](int i) { return mesh.GetBdrAttribute(i); }),
                named.GetComm());
   const Point3 place = MeanPlace(named);
   Vector low;
   Vector high;
   mesh.GetBoundingBox(low, high);
   for (int d = 0; d < 3; d++)
   {
      contents.numbers[place_names[d]] = place[d];
      contents.numbers[low_names[d]] = low[d];
      contents.numbers[high_names[d]] = high[d];
   }
}
} // namespace

void AddFingerprint(BiphasicProblem &problem, CheckpointContents &contents)
{
   AddMesh(problem.Mesh(), contents);
   contents.texts["order"] = std::to_string(problem.Spaces().Order());
   contents.texts["deformation"] =
      problem.GetDeformation() == Deformation::finite ? "finite"
                                                      : "infinitesimal";
   contents.texts["degrees of freedom"] =
      std::to_string(problem.Spaces().Displacement().GlobalTrueVSize() +
                     problem.Spaces().Pressure().GlobalTrueVSize());
   std::string pairs;
   for (const ContactPair *pair : problem.Operator().Pairs())
   {
      pairs += (pairs.empty() ? "" : ", ") + pair->Name();
   }
   contents.texts["contact pairs"] = pairs.empty() ? "none" : pairs;
   std::string ties;
   for (const TiedInterface *tie : problem.Operator().Interfaces())
   {
      ties += (ties.empty() ? "" : ", ") + tie->Name();
   }
   contents.texts["ties"] = ties.empty() ? "none" : ties;
   std::string rigid;
   for (const RigidBody &body : problem.Conditions().RigidBodies())
   {
      rigid += (rigid.empty() ? "" : ", ") + body.name;
   }
   contents.texts["rigid bodies"] = rigid.empty() ? "none" : rigid;
}

std::string CompareFingerprints(const CheckpointContents &theirs,
                                const CheckpointContents &ours)
{
   std::string differences;
   const auto add = [&](const std::string &name, const std::string &there,
                        const std::string &here)
   {
      differences += (differences.empty() ? "" : "; ") + name + ": " + there +
                     " there, " + here + " here";
   };
   for (const char *name :
        {"contact pairs", "deformation", "degrees of freedom", "elements",
         "materials", "order", "regions", "rigid bodies", "surfaces", "ties"})
   {
      const auto there = theirs.texts.find(name);
      const std::string &here = ours.texts.at(name);
      // Checkpoints of the first version lack some entries.
      if (there != theirs.texts.end() && there->second != here)
      {
         add(name, there->second, here);
      }
   }
   real_t size = 0.0;
   for (int d = 0; d < 3; d++)
   {
      size = std::max(size, ours.numbers.at(high_names[d]) -
                               ours.numbers.at(low_names[d]));
   }
   const auto compare =
      [&](const std::string &what, const char *const(&names)[3])
   {
      for (const char *name : names)
      {
         const auto there = theirs.numbers.find(name);
         const real_t here = ours.numbers.at(name);
         if (there != theirs.numbers.end() &&
             std::abs(there->second - here) > tolerance * size)
         {
            add(what, ToText(there->second), ToText(here));
            return;
         }
      }
   };
   compare("mean position of the elements", place_names);
   compare("lower end of the mesh", low_names);
   compare("upper end of the mesh", high_names);
   return differences;
}

} // namespace synovia
