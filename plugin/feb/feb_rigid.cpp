#include "synovia/feb/feb_model.hpp"

namespace synovia
{

using namespace mfem;

namespace
{
// Of a freedom's word among those of translations and rotations; -1 if it is
// another.
int Freedom(const std::string &dof)
{
   const std::array<std::vector<std::string>, 6> words{{{"x", "Rx"},
                                                        {"y", "Ry"},
                                                        {"z", "Rz"},
                                                        {"u", "Ru"},
                                                        {"v", "Rv"},
                                                        {"w", "Rw"}}};
   for (int i = 0; i < 6; i++)
   {
      for (const std::string &word : words[i])
      {
         if (dof == word)
         {
            return i;
         }
      }
   }
   return -1;
}

void Prescribe(int freedom, const LoadCurve &value, RigidBodyCase &body)
{
   (freedom < 3 ? body.translation : body.rotation)[freedom % 3] = value;
}

void ReadFixed(const FebInput &condition, RigidBodyCase &body)
{
   const char *const names[6] = {"Rx_dof", "Ry_dof", "Rz_dof",
                                 "Ru_dof", "Rv_dof", "Rw_dof"};
   for (int i = 0; i < 6; i++)
   {
      if (condition.Flag(names[i], false))
      {
         Prescribe(i, LoadCurve(0.0), body);
      }
   }
}

// The freedom that <dof> names; -1, and an error, if there is none.
int ReadFreedom(const FebInput &from)
{
   const std::string word = from.Word("dof", "");
   const int freedom = Freedom(word);
   if (freedom < 0)
   {
      from.Stop("the freedom \"" + word + "\" is not known");
   }
   return freedom;
}

void ReadLoad(const FebInput &load, int freedom, const LoadCurve &value,
              RigidBodyCase &body)
{
   const std::string type = load.Word("load_type", "LOAD");
   if (type != "LOAD" && type != "0")
   {
      load.Stop("loads of the type \"" + type +
                "\" are not known; there is LOAD");
   }
   std::optional<std::array<LoadCurve, 3>> &loads =
      freedom < 3 ? body.force : body.moment;
   if (!loads)
   {
      loads = std::array<LoadCurve, 3>{{0.0, 0.0, 0.0}};
   }
   (*loads)[freedom % 3] = value;
}

void ReadEntry(const FebInput &entry, FebModel &model)
{
   const std::string type = entry.NeededAttribute("type");
   entry.Attribute("name");
   const bool fixed = type == "rigid_fixed";
   const bool moved = type == "rigid_displacement" || type == "rigid_rotation";
   const bool loaded = type == "rigid_force" || type == "rigid_moment";
   if (!fixed && !moved && !loaded)
   {
      entry.StopAll("\"" + type +
                    "\" is not known; there are rigid_fixed, "
                    "rigid_displacement, rigid_rotation, rigid_force, "
                    "rigid_moment");
      return;
   }
   RigidBodyCase *body = model.FindRigid(entry.Word("rb", ""), entry);
   if (!body)
   {
      entry.StopAll("it belongs to a rigid body that is not known");
      return;
   }
   if (fixed)
   {
      ReadFixed(entry, *body);
      return;
   }
   entry.Expect("relative", false,
                "values relative to those at the start are not known");
   const int freedom = ReadFreedom(entry);
   const LoadCurve value = model.Value(entry, "value");
   if (freedom < 0)
   {
      return;
   }
   if (moved)
   {
      Prescribe(freedom, value, *body);
   }
   else
   {
      ReadLoad(entry, freedom, value, *body);
   }
}
} // namespace

void ReadRigid(const FebInput &section, FebModel &model)
{
   for (const char *name : {"rigid_bc", "rigid_constraint", "rigid_load"})
   {
      for (const FebInput &entry : section.All(name))
      {
         ReadEntry(entry, model);
      }
   }
}

} // namespace synovia
