#include "synovia/feb/feb_model.hpp"
#include "synovia/feb/feb_surfaces.hpp"

#include <algorithm>

namespace synovia
{

using namespace mfem;

namespace
{
/// What springs are made of, by number and name.
struct FebSpringMaterial
{
   std::string number;
   std::string name;
   LigamentOptions options;
};

FebSpringMaterial ReadSpringMaterial(const FebInput &input)
{
   FebSpringMaterial material;
   material.number = input.Attribute("id");
   material.name = input.Attribute("name");
   const std::string type = input.NeededAttribute("type");
   const bool tension = type == "tension-only linear spring" ||
                        type == "tension only linear spring";
   if (!tension && type != "linear spring")
   {
      input.StopAll("discrete materials of the type \"" + type +
                    "\" are not known; there are linear spring, tension-only "
                    "linear spring");
      return material;
   }
   material.options.compression = !tension;
   material.options.stiffness = input.Number("E", 0.0);
   if (!(material.options.stiffness > 0.0))
   {
      input.Stop("E must be positive");
   }
   return material;
}

/// Names of the rigid bodies that nodes belong or are tied to, by their places.
using RigidNodes = std::map<int, std::string>;

RigidNodes FindRigidNodes(const FebModel &model)
{
   RigidNodes bodies;
   for (size_t i = 0; i < model.materials.rigid.size(); i++)
   {
      const RigidBodyCase &body = model.setup.rigid_bodies[i];
      for (const int part : model.materials.rigid[i].parts)
      {
         for (const FebCell &cell : model.mesh.parts[part].cells)
         {
            for (const int node : cell.nodes)
            {
               bodies.emplace(node, body.name);
            }
         }
      }
      for (const std::string &surface : body.surfaces)
      {
         for (const auto &corner : model.surfaces->NodalAreas(surface))
         {
            bodies.emplace(corner.first, body.name);
         }
      }
   }
   return bodies;
}

LigamentEnd ReadEnd(const FebInput &where, int node, const RigidNodes &bodies,
                    const FebMesh &mesh)
{
   LigamentEnd end;
   end.point = mesh.nodes[node];
   const auto found = bodies.find(node);
   if (found != bodies.end())
   {
      end.body = found->second;
   }
   else
   {
      where.Stop("node " + std::to_string(mesh.numbers[node]) +
                 " belongs to no rigid body; discrete springs are between "
                 "rigid bodies");
   }
   return end;
}

void AddSprings(const FebInput &discrete,
                const std::vector<FebSpringMaterial> &materials,
                const RigidNodes &bodies, FebModel &model)
{
   const std::string called = discrete.NeededAttribute("dmat");
   const auto material =
      std::find_if(materials.begin(), materials.end(),
                   [&called](const FebSpringMaterial &m)
                   { return m.number == called || m.name == called; });
   const std::string name = discrete.NeededAttribute("discrete_set");
   const auto set = model.mesh.discrete_sets.find(name);
   if (material == materials.end() || set == model.mesh.discrete_sets.end())
   {
      discrete.Stop(material == materials.end()
                       ? "there is no discrete material \"" + called + "\""
                       : "there is no DiscreteSet \"" + name + "\"");
      return;
   }
   int count = 0;
   for (const auto &[first, second] : set->second)
   {
      Ligament spring;
      spring.name = PlainName(name);
      if (set->second.size() > 1)
      {
         spring.name += "_" + std::to_string(++count);
      }
      spring.options = material->options;
      spring.from = ReadEnd(discrete, first, bodies, model.mesh);
      spring.to = ReadEnd(discrete, second, bodies, model.mesh);
      if (spring.from.body == spring.to.body && !spring.to.body.empty())
      {
         discrete.Stop("both ends of \"" + spring.name +
                       "\" belong to the rigid body \"" + spring.to.body +
                       "\", so that it bears nothing");
      }
      model.setup.ligaments.push_back(spring);
   }
}
} // namespace

void ReadDiscrete(const FebInput &section, FebModel &model)
{
   std::vector<FebSpringMaterial> materials;
   for (const FebInput &material : section.All("discrete_material"))
   {
      materials.push_back(ReadSpringMaterial(material));
   }
   const RigidNodes bodies = FindRigidNodes(model);
   for (const FebInput &discrete : section.All("discrete"))
   {
      AddSprings(discrete, materials, bodies, model);
   }
}

} // namespace synovia
