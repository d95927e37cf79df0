#include "synovia/feb/feb_model.hpp"

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

void ReadPair(const FebInput &contact, FebModel &model)
{
   const std::string type = contact.NeededAttribute("type");
   if (type != "sliding-biphasic" && type != "sliding2")
   {
      contact.StopAll("contact of the type \"" + type +
                      "\" is not known; there is sliding-biphasic");
      return;
   }
   ContactCase pair;
   pair.name = PlainName(contact.Attribute("name"));
   pair.options.configuration = SearchConfiguration::current;
   IgnorePenalties(contact);
   contact.Expect("fric_coeff", false, "friction is not known");
   for (const char *name : {"contact_frac", "smooth_fls"})
   {
      contact.Ignore(name, "it belongs to friction");
   }
   contact.Expect("node_reloc", false, "nodes are not moved before contact");
   for (const char *name : {"flip_primary", "flip_secondary",
                            "shell_bottom_primary", "shell_bottom_secondary"})
   {
      contact.Expect(name, false, "surfaces of shells are not known");
   }
   const std::string name = contact.NeededAttribute("surface_pair");
   const auto surfaces = model.mesh.surface_pairs.find(name);
   if (surfaces == model.mesh.surface_pairs.end())
   {
      contact.Stop("there is no pair of surfaces called \"" + name + "\"");
      return;
   }
   const std::string primary =
      model.surfaces->OfFacets(surfaces->second.first, contact);
   const std::string secondary =
      model.surfaces->OfFacets(surfaces->second.second, contact);
   pair.destination = {primary};
   pair.source = {secondary};
   if (!primary.empty() && !secondary.empty())
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
