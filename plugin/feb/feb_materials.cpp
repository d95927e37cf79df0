#include "synovia/feb/feb_materials.hpp"
#include "synovia/feb/feb_laws.hpp"

namespace synovia
{

using namespace mfem;

namespace
{
// Cases have none without a solid.
constexpr real_t least_solid_fraction = 1e-9;

// That of body loads.
real_t ReadDensity(const FebInput &from, const std::string &child,
                   real_t standard)
{
   const real_t density = from.Number(child, standard);
   if (!(density >= 0.0))
   {
      from.Stop(child + " must not be negative");
      return standard;
   }
   return density;
}

SupplyCase ReadSupply(const FebInput &supply)
{
   SupplyCase result;
   const std::string type = supply.NeededAttribute("type");
   if (type != "Starling")
   {
      supply.StopAll("supplies of the type \"" + type +
                     "\" are not known; there is Starling");
      return result;
   }
   result.model = SupplyModel::starling;
   result.starling.kp = supply.Number("kp", 0.0);
   result.starling.pc = supply.Number("pv", 0.0);
   if (!(result.starling.kp >= 0.0))
   {
      supply.Stop("kp must not be negative");
   }
   return result;
}

MaterialCase ReadBiphasic(const FebInput &material, FebFrame &frame)
{
   MaterialCase result;
   result.solid_fraction = material.Number("phi0", 0.0);
   if (!(result.solid_fraction >= 0.0 && result.solid_fraction < 1.0))
   {
      material.Stop("phi0 must be at least 0 and below 1");
   }
   if (result.solid_fraction == 0.0)
   {
      result.solid_fraction = least_solid_fraction;
      material.Approximate("phi0 = 0 is taken for 1e-9");
   }
   result.fluid_density = ReadDensity(material, "fluid_density", 0.0);
   material.Ignore("density", "that of the solid counts");
   material.Expect("tau", false, "tau other than 0 is not known");
   if (const std::optional<FebInput> supply = material.Find("solvent_supply"))
   {
      result.supply = ReadSupply(*supply);
   }
   const std::optional<FebInput> permeability = material.Find("permeability");
   const std::optional<FebInput> solid = material.Find("solid");
   if (!permeability || !solid)
   {
      material.Stop("a biphasic material has a solid and a permeability");
      return result;
   }
   result.permeability = ReadPermeability(*permeability, frame);
   result.solid_density = ReadDensity(*solid, "density", 1.0);
   result.solid = ReadSolid(*solid, frame);
   return result;
}

MaterialCase ReadElastic(const FebInput &material, FebFrame &frame)
{
   MaterialCase result;
   result.permeability.model = PermeabilityCase::none;
   result.solid_density = ReadDensity(material, "density", 1.0);
   result.solid = ReadSolid(material, frame);
   return result;
}

FebRigidMaterial ReadRigid(const FebInput &material)
{
   FebRigidMaterial rigid{material.Attribute("id"), material.Attribute("name"),
                          material};
   rigid.density = ReadDensity(material, "density", 1.0);
   for (const char *name : {"E", "v"})
   {
      material.Ignore(name, "a rigid body has no strain");
   }
   const std::optional<FebInput> center = material.Find("center_of_mass");
   if (!center)
   {
      material.Stop("center_of_mass is missing; forces and rotations are "
                    "about it");
      return rigid;
   }
   const std::vector<real_t> x = center->Numbers();
   if (x.size() == 3)
   {
      rigid.center = {x[0], x[1], x[2]};
   }
   else
   {
      center->Stop("a point has three coordinates");
   }
   return rigid;
}
} // namespace

FebMaterials ReadMaterials(const FebInput &section, const FebMesh &mesh,
                           const FebElementData &data)
{
   FebMaterials result;
   std::set<int> left;
   for (size_t p = 0; p < mesh.parts.size(); p++)
   {
      left.insert(static_cast<int>(p));
   }
   for (const FebInput &material : section.All("material"))
   {
      const std::string number = material.Attribute("id");
      const std::string name = material.Attribute("name");
      const std::string type = material.NeededAttribute("type");
      std::vector<int> parts;
      for (const int p : left)
      {
         const std::string &word = mesh.parts[p].material;
         if (!word.empty() && (word == name || word == number))
         {
            parts.push_back(p);
         }
      }
      for (const int p : parts)
      {
         left.erase(p);
      }
      if (type == "rigid body")
      {
         result.rigid.push_back(ReadRigid(material));
         result.rigid.back().parts.insert(parts.begin(), parts.end());
         continue;
      }
      if (type != "biphasic" && !IsSolidType(type))
      {
         material.StopAll("materials of the type \"" + type +
                          "\" are not known; there are biphasic, rigid body, "
                          "and solids without fluid");
         continue;
      }
      FebFrame frame(material, {mesh, data, parts},
                     "directions of material " + number);
      MaterialCase entry = type == "biphasic" ? ReadBiphasic(material, frame)
                                              : ReadElastic(material, frame);
      entry.frame = frame.Case();
      if (!frame.Field().empty())
      {
         result.fields[entry.frame.name] = frame.Field();
      }
      for (const int p : parts)
      {
         if (mesh.parts[p].shape->dimension != 3)
         {
            material.Stop("shells of \"" + mesh.parts[p].name +
                          "\" are of this material; only rigid shells are "
                          "read");
            continue;
         }
         entry.regions.push_back(mesh.parts[p].name);
         result.deformable.insert(p);
      }
      if (entry.regions.empty())
      {
         material.IgnoreAll("no elements are of this material");
      }
      else
      {
         result.materials.push_back(entry);
      }
   }
   for (const int p : left)
   {
      section.Stop("the elements \"" + mesh.parts[p].name + "\" (line " +
                   std::to_string(mesh.parts[p].line) + ") have no material");
   }
   return result;
}

} // namespace synovia
