#include "synovia/feb/feb_conditions.hpp"

#include <algorithm>
#include <array>
#include <set>

namespace synovia
{

using namespace mfem;

namespace
{
void IgnorePenalties(const FebInput &contact)
{
   for (const char *name :
        {"laugon", "tolerance", "gaptol", "ptol", "penalty", "auto_penalty",
         "update_penalty", "two_pass", "knmult", "search_tol",
         "pressure_penalty", "symmetric_stiffness", "search_radius", "seg_up",
         "minaug", "maxaug", "smooth_aug"})
   {
      contact.Ignore(name, "gaps and pressure jumps are closed by augmented "
                           "Lagrangians whose settings follow from the "
                           "bodies");
   }
}

// Friction on the share of the load that the solids bear, as FEBio has it.
FrictionOptions ReadFriction(const FebInput &contact)
{
   // 0 would be the product of the solid fractions of both sides.
   constexpr real_t no_solid = 1e-12;
   FrictionOptions friction;
   friction.coefficient = contact.Number("fric_coeff", 0.0);
   const real_t fraction = contact.Number("contact_frac", 0.0);
   if (friction.coefficient != 0.0)
   {
      friction.solid_fraction = std::max(no_solid, fraction);
   }
   if (!(friction.coefficient >= 0.0) || !(friction.solid_fraction <= 1.0))
   {
      contact.Stop("fric_coeff must not be negative, and contact_frac must be "
                   "between 0 and 1");
   }
   contact.Ignore("smooth_fls", "fluid load support is always that of averages "
                                "around the nodes");
   return friction;
}

bool IsRigid(const std::string &surface, FebModel &model)
{
   const std::vector<int> *nodes =
      model.surfaces->FindNodes("@surface:" + surface);
   return nodes && model.AreRigid(*nodes);
}

/// Names of primary and secondary surfaces, in the model and in the mesh; none
/// of them after an error.
struct FebSurfacePair
{
   std::array<std::string, 2> facets;
   std::array<std::string, 2> surfaces;

   bool IsThere() const { return !surfaces[0].empty() && !surfaces[1].empty(); }
};

FebSurfacePair ReadSurfaces(const FebInput &contact, FebModel &model)
{
   for (const char *name : {"flip_primary", "flip_secondary",
                            "shell_bottom_primary", "shell_bottom_secondary"})
   {
      contact.Expect(name, false, "surfaces of shells are not known");
   }
   FebSurfacePair pair;
   const std::string name = contact.NeededAttribute("surface_pair");
   const auto found = model.mesh.surface_pairs.find(name);
   if (found == model.mesh.surface_pairs.end())
   {
      contact.Stop("there is no pair of surfaces called \"" + name + "\"");
      return pair;
   }
   pair.facets = {found->second.first, found->second.second};
   for (int i = 0; i < 2; i++)
   {
      pair.surfaces[i] = model.surfaces->OfFacets(pair.facets[i], contact);
   }
   return pair;
}

void ReadTie(const FebInput &contact, FebModel &model)
{
   TieCase tie;
   tie.name = PlainName(contact.Attribute("name"));
   IgnorePenalties(contact);
   const FebSurfacePair pair = ReadSurfaces(contact, model);
   for (const std::string &facets : pair.facets)
   {
      if (pair.IsThere() && IsRigid(facets, model))
      {
         contact.Stop("the surface \"" + facets +
                      "\" is of a rigid body; tie the other one to that body");
         return;
      }
   }
   tie.destination = {pair.surfaces[0]};
   tie.source = {pair.surfaces[1]};
   if (pair.IsThere())
   {
      model.setup.ties.push_back(tie);
   }
}

// Whether all nodes of the surface belong to solids with fluid.
bool IsWet(const std::string &surface, FebModel &model)
{
   std::set<int> wet;
   for (const MaterialCase &material : model.setup.materials)
   {
      for (const FebPart &part : model.mesh.parts)
      {
         const bool of_material =
            std::find(material.regions.begin(), material.regions.end(),
                      part.name) != material.regions.end();
         for (const FebCell &cell : part.cells)
         {
            if (of_material && material.HasFluid())
            {
               wet.insert(cell.nodes.begin(), cell.nodes.end());
            }
         }
      }
   }
   const std::vector<int> *nodes =
      model.surfaces->FindNodes("@surface:" + surface);
   return nodes &&
          std::all_of(nodes->begin(), nodes->end(),
                      [&wet](int node) { return wet.count(node) > 0; });
}

bool IsFixed(const RigidBodyCase &body)
{
   const auto holds = [](const std::optional<LoadCurve> &curve)
   { return curve && curve->IsZero(); };
   return std::all_of(body.translation.begin(), body.translation.end(),
                      holds) &&
          std::all_of(body.rotation.begin(), body.rotation.end(), holds);
}

// A surface that slides along a plane.
void AddGuide(const FebInput &contact, FebModel &model)
{
   const std::string pair = contact.NeededAttribute("surface_pair");
   const auto guide = std::find_if(model.guides.begin(), model.guides.end(),
                                   [&pair](const FebGuide &entry)
                                   { return entry.pair == pair; });
   if (guide == model.guides.end())
   {
      contact.StopAll("it bears tension along no plane");
      return;
   }
   if (!IsFixed(model.setup.rigid_bodies[guide->body]))
   {
      contact.Stop("contact bears tension only where the rigid body is fixed");
   }
   if (contact.Number("fric_coeff", 0.0) != 0.0)
   {
      contact.Stop("contact that bears tension has no friction");
   }
   contact.IgnoreAll(
      "however it is enforced, the surface keeps to the plane (guide)");
   const std::string surface =
      model.surfaces->OfFacets(guide->surface, contact);
   if (!surface.empty())
   {
      BoundaryCase boundary;
      boundary.surfaces = {surface};
      boundary.guide = guide->normal;
      AddCondition(boundary, contact, model);
   }
}

void ReadPair(const FebInput &contact, FebModel &model)
{
   const std::string type = contact.NeededAttribute("type");
   if (type == "tied-biphasic" || type == "tied-elastic")
   {
      ReadTie(contact, model);
      return;
   }
   const bool elastic = type == "sliding-elastic";
   if (!elastic && type != "sliding-biphasic" && type != "sliding2")
   {
      contact.StopAll("contact of the type \"" + type +
                      "\" is not known; there are sliding-biphasic, "
                      "sliding-elastic, tied-biphasic and tied-elastic");
      return;
   }
   if (contact.Flag("tension", false))
   {
      AddGuide(contact, model);
      return;
   }
   ContactCase pair;
   pair.name = PlainName(contact.Attribute("name"));
   pair.options.configuration = SearchConfiguration::current;
   IgnorePenalties(contact);
   pair.options.friction = ReadFriction(contact);
   contact.Expect("node_reloc", false, "nodes are not moved before contact");
   contact.Expect("offset", false, "surfaces touch where they are");
   const FebSurfacePair surfaces = ReadSurfaces(contact, model);
   if (!surfaces.IsThere())
   {
      return;
   }
   const auto &[primary, secondary] = surfaces.facets;
   pair.destination = {surfaces.surfaces[0]};
   pair.source = {surfaces.surfaces[1]};
   const bool rigid_primary = IsRigid(primary, model);
   const bool wet_primary = IsWet(primary, model);
   const bool wet_secondary = IsWet(secondary, model);
   if (elastic && (wet_primary || wet_secondary))
   {
      contact.Stop("the surfaces of sliding-elastic have no fluid behind them "
                   "here; sliding-biphasic lets it pass");
   }
   if (rigid_primary && IsRigid(secondary, model))
   {
      contact.Stop("both surfaces are of rigid bodies");
   }
   const FrictionOptions &friction = pair.options.friction;
   const bool rubs = friction.coefficient > 0.0;
   if (rigid_primary || (rubs && !wet_primary && wet_secondary))
   {
      // Rigid surfaces bear no multipliers, and friction depends on the fluid
      // of the side that does.
      std::swap(pair.destination, pair.source);
   }
   if (rubs && friction.solid_fraction < 1.0 && wet_primary && wet_secondary)
   {
      // Pressures of order 1 alternate from node to node where hardly any fluid
      // flows, and friction would follow them.
      model.setup.space.stabilization = 1.0;
      contact.Approximate("pressures are stabilized (space.stabilization = 1), "
                          "as friction between two surfaces with fluid follows "
                          "them");
   }
   model.setup.contacts.push_back(pair);
}
} // namespace

void ReadContact(const FebInput &section, FebModel &model)
{
   for (const FebInput &contact : section.All("contact"))
   {
      ReadPair(contact, model);
   }
}

} // namespace synovia
