#include "synovia/feb/feb_model.hpp"

#include <algorithm>
#include <array>

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

void ReadPair(const FebInput &contact, FebModel &model)
{
   const std::string type = contact.NeededAttribute("type");
   if (type == "tied-biphasic" || type == "tied-elastic")
   {
      ReadTie(contact, model);
      return;
   }
   if (type != "sliding-biphasic" && type != "sliding2")
   {
      contact.StopAll("contact of the type \"" + type +
                      "\" is not known; there are sliding-biphasic, "
                      "tied-biphasic and tied-elastic");
      return;
   }
   ContactCase pair;
   pair.name = PlainName(contact.Attribute("name"));
   pair.options.configuration = SearchConfiguration::current;
   IgnorePenalties(contact);
   pair.options.friction = ReadFriction(contact);
   contact.Expect("node_reloc", false, "nodes are not moved before contact");
   const FebSurfacePair surfaces = ReadSurfaces(contact, model);
   pair.destination = {surfaces.surfaces[0]};
   pair.source = {surfaces.surfaces[1]};
   const bool rigid_primary = IsRigid(surfaces.facets[0], model);
   if (rigid_primary && IsRigid(surfaces.facets[1], model))
   {
      contact.Stop("both surfaces are of rigid bodies");
   }
   if (rigid_primary)
   {
      // Rigid surfaces bear no multipliers.
      std::swap(pair.destination, pair.source);
   }
   if (surfaces.IsThere())
   {
      model.setup.contacts.push_back(pair);
   }
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
