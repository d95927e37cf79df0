#include "synovia/cases/law_checks.hpp"
#include "synovia/cases/case_words.hpp"
#include "synovia/cases/key_names.hpp"
#include "synovia/general/error.hpp"
#include "synovia/materials/law_registry.hpp"

namespace synovia
{

using namespace mfem;

namespace
{
const char *const deformation_key = "physics.deformation";

std::vector<std::string> AllQuoted(std::vector<std::string> names)
{
   for (std::string &name : names)
   {
      name = Quoted(name);
   }
   return names;
}

void CheckVectors(const LawDescription &law,
                  const std::map<std::string, Point3> &vectors,
                  const std::string &path, CaseReading &reading)
{
   for (const auto &[name, value] : vectors)
   {
      const std::string here = path + "." + name;
      const LawVector *const vector = law.FindVector(name);
      reading.Require(vector, here,
                      Quoted(law.name) + " has no such parameter");
      if (!reading.HasError(here))
      {
         reading.Catch(here, [&, &x = value]() { vector->Verify(x); });
      }
   }
}

template <typename Law>
void CheckLaw(const LawRegistry<Law> &laws, const std::string &model,
              const std::map<std::string, real_t> &parameters,
              const std::string &path, Deformation deformation,
              CaseReading &reading)
{
   const LawDescription *const law = laws.Find(model);
   const std::string model_path = path + ".model";
   if (!law || reading.HasError(model_path))
   {
      return;
   }
   for (const auto &[name, value] : parameters)
   {
      reading.Require(law->Find(name), path + "." + name,
                      Quoted(model) + " has no such parameter");
   }
   if (!law->Allows(deformation))
   {
      const std::string needed = DeformationWord(*law->only_for);
      reading.AddError(
         model_path,
         Quoted(model) + " is a law of " + needed + " deformation; set " +
            deformation_key + " = " + Quoted(needed) + " (" +
            WhereIs(reading.Places(), deformation_key) + "), or take one of " +
            JoinedNames(AllQuoted(laws.Names(deformation))));
   }
}
} // namespace

void CheckLaws(const MaterialCase &material, const std::string &path,
               Deformation deformation, CaseReading &reading)
{
   const auto check_solid = [&](const SolidCase &solid, const std::string &at)
   {
      CheckLaw(SolidLaws(), solid.model, solid.parameters, at, deformation,
               reading);
      const LawDescription *const law = SolidLaws().Find(solid.model);
      if (law)
      {
         CheckVectors(*law, solid.vectors, at, reading);
      }
      if (law && law->has_fibers)
      {
         CheckLaw(SolidLaws(), solid.fibers.model, solid.fibers.parameters,
                  at + ".fibers", deformation, reading);
      }
   };
   const std::string solid_path = path + ".solid";
   const SolidCase &solid = material.solid;
   check_solid(solid, solid_path);
   const LawDescription *const law = SolidLaws().Find(solid.model);
   const std::string parts_path = solid_path + ".solids";
   reading.Require(!law || !law->has_parts || !solid.solids.empty(), parts_path,
                   "there is no solid in the mixture");
   for (size_t i = 0; i < solid.solids.size(); i++)
   {
      check_solid(solid.solids[i], parts_path + "." + std::to_string(i));
   }
   if (material.permeability.model == PermeabilityCase::none)
   {
      reading.Require(material.permeability.parameters.empty(),
                      path + ".permeability",
                      "there are parameters, but no fluid");
      reading.Require(material.supply.model == SupplyModel::none,
                      path + ".supply", "there is a supply, but no fluid");
      return;
   }
   CheckLaw(PermeabilityLaws(), material.permeability.model,
            material.permeability.parameters, path + ".permeability",
            deformation, reading);
}

} // namespace synovia
