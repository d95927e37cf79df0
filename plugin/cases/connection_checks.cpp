#include "synovia/cases/connection_checks.hpp"
#include "synovia/cases/key_names.hpp"
#include "synovia/cases/name_checks.hpp"

#include <algorithm>

namespace synovia
{

namespace
{
std::vector<std::string> RigidBodyNames(const CaseFile &setup)
{
   std::vector<std::string> names;
   for (const RigidBodyCase &body : setup.rigid_bodies)
   {
      names.push_back(body.name);
   }
   return names;
}

// Says whether the body is known, or that of a name with an error.
bool CheckBody(const std::string &body, const std::string &path,
               const std::vector<std::string> &known, CaseReading &reading)
{
   const bool is_known = body.empty() || std::find(known.begin(), known.end(),
                                                   body) != known.end();
   reading.Require(is_known, path,
                   "there is no rigid body " + Quoted(body) +
                      DidYouMean(body, known));
   return is_known;
}

void CheckName(const std::string &name, const std::string &kind,
               const std::string &path, Once &once, CaseReading &reading)
{
   reading.Require(!name.empty(), path, "the name is empty");
   if (!name.empty())
   {
      once.Enter(name, path,
                 "a " + kind + " is called " + Quoted(name) +
                    " already; give this one another name");
      CheckFileName(name, path, reading);
   }
}

void CheckLigaments(const CaseFile &setup, CaseReading &reading)
{
   const std::vector<std::string> known = RigidBodyNames(setup);
   Once names(reading);
   for (size_t i = 0; i < setup.ligaments.size(); i++)
   {
      const Ligament &ligament = setup.ligaments[i];
      const std::string path = EntryPath("ligament", i);
      CheckName(ligament.name, "ligament", path + ".name", names, reading);
      bool good = !reading.HasError(path + ".from.point") &&
                  !reading.HasError(path + ".to.point");
      good =
         CheckBody(ligament.from.body, path + ".from.body", known, reading) &&
         good;
      good =
         CheckBody(ligament.to.body, path + ".to.body", known, reading) && good;
      if (good)
      {
         const std::string problem = Contradiction(ligament, known);
         reading.Require(problem.empty(), path, problem);
      }
   }
}

void CheckJoints(const CaseFile &setup, CaseReading &reading)
{
   const std::vector<std::string> known = RigidBodyNames(setup);
   Once names(reading);
   for (size_t i = 0; i < setup.joints.size(); i++)
   {
      const Joint &joint = setup.joints[i];
      const std::string path = EntryPath("joint", i);
      CheckName(joint.name, "joint", path + ".name", names, reading);
      bool good = true;
      for (const auto &[side, key] : {std::pair(&joint.proximal, ".proximal"),
                                      std::pair(&joint.distal, ".distal")})
      {
         good = !reading.HasError(path + key + ".flexion_axis") &&
                !reading.HasError(path + key + ".long_axis") && good;
         good =
            CheckBody(side->body, path + key + ".body", known, reading) && good;
      }
      if (good)
      {
         const std::string problem = Contradiction(joint, known);
         reading.Require(problem.empty(), path, problem);
      }
   }
}
} // namespace

void CheckConnections(const CaseFile &setup, CaseReading &reading)
{
   CheckLigaments(setup, reading);
   CheckJoints(setup, reading);
}

} // namespace synovia
