#include "synovia/feb/feb_joints.hpp"

#include <algorithm>

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

std::optional<LoadCurve> &Motion(int freedom, RigidBodyCase &body)
{
   return (freedom < 3 ? body.translation : body.rotation)[freedom % 3];
}

// Relative to where the body is when a step begins, or not.
void Prescribe(int freedom, const LoadCurve &value, bool relative,
               RigidBodyCase &body, FebModel &model)
{
   Motion(freedom, body) = value;
   model.relative[body.name][freedom] = relative && model.in_step;
}

// FEBio fixes freedoms that nothing else prescribes.
void Fix(int freedom, RigidBodyCase &body, FebModel &model)
{
   if (!Motion(freedom, body))
   {
      Prescribe(freedom, LoadCurve(0.0), true, body, model);
   }
}

// Loads add up.
void AddLoad(int freedom, const LoadCurve &value, RigidBodyCase &body)
{
   std::optional<std::array<LoadCurve, 3>> &loads =
      freedom < 3 ? body.force : body.moment;
   if (!loads)
   {
      loads = std::array<LoadCurve, 3>{{0.0, 0.0, 0.0}};
   }
   LoadCurve &load = (*loads)[freedom % 3];
   load = Sum(load, 1.0, value);
}

void ReadFixed(const FebInput &condition, RigidBodyCase &body, FebModel &model)
{
   std::string word;
   for (const char c : condition.Word("dofs", "") + ",")
   {
      if (c != ',' && c != ' ')
      {
         word += c;
         continue;
      }
      const int freedom = Freedom(word);
      if (freedom >= 0)
      {
         Fix(freedom, body, model);
      }
      else if (!word.empty())
      {
         condition.Stop("the freedom \"" + word + "\" is not known");
      }
      word.clear();
   }
   const char *const names[6] = {"Rx_dof", "Ry_dof", "Rz_dof",
                                 "Ru_dof", "Rv_dof", "Rw_dof"};
   for (int i = 0; i < 6; i++)
   {
      if (condition.Flag(names[i], false))
      {
         Fix(i, body, model);
      }
   }
}

// <rigid_body mat="3"> in the section Boundary of version 2.5.
void ReadFormerBody(const FebInput &conditions, FebModel &model)
{
   RigidBodyCase *body =
      model.FindRigid(conditions.NeededAttribute("mat"), conditions);
   if (!body)
   {
      conditions.StopAll("its conditions go unread");
      return;
   }
   for (const FebInput &condition : conditions.All())
   {
      // R stands for rotations here.
      const std::string word = condition.NeededAttribute("bc");
      const bool turns = word.size() == 2 && word[0] == 'R';
      const int along = Freedom(turns ? word.substr(1) : word);
      const int freedom = turns && along >= 0 ? along + 3 : along;
      if (freedom < 0)
      {
         condition.Stop("the freedom \"" + word + "\" is not known");
      }
      else if (condition.Name() == "fixed")
      {
         Fix(freedom, *body, model);
      }
      else if (condition.Name() == "prescribed")
      {
         Prescribe(freedom, model.Value(condition), false, *body, model);
      }
      else if (condition.Name() == "force")
      {
         AddLoad(freedom, model.Value(condition), *body);
      }
      else
      {
         condition.StopAll("there are fixed, prescribed and force");
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
   AddLoad(freedom, value, body);
}

void ReadEntry(const FebInput &entry, FebModel &model)
{
   const std::string type = entry.NeededAttribute("type");
   entry.Attribute("name");
   // Version 3.0 has other words.
   const bool fixed = type == "rigid_fixed" || type == "fix";
   const bool moved = type == "rigid_displacement" ||
                      type == "rigid_rotation" || type == "prescribe";
   const bool loaded =
      type == "rigid_force" || type == "rigid_moment" || type == "force";
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
      ReadFixed(entry, *body, model);
      return;
   }
   const bool relative = entry.Flag("relative", false);
   if (relative && !moved)
   {
      entry.Stop("loads relative to those before are not known");
   }
   const int freedom = ReadFreedom(entry);
   const LoadCurve value = model.Value(entry, "value");
   if (freedom < 0)
   {
      return;
   }
   if (moved)
   {
      Prescribe(freedom, value, relative, *body, model);
   }
   else
   {
      ReadLoad(entry, freedom, value, *body);
   }
}

// The end of a spring at one of the bodies a and b.
LigamentEnd ReadEnd(const FebInput &spring, const std::string &which,
                    FebModel &model)
{
   LigamentEnd end;
   const RigidBodyCase *body =
      model.FindRigid(spring.Word("body_" + which, ""), spring);
   end.body = body ? body->name : "";
   const std::optional<FebInput> place = spring.Find("insertion_" + which);
   const std::vector<real_t> point =
      place ? place->Numbers() : std::vector<real_t>(3, 0.0);
   if (point.size() == 3)
   {
      std::copy(point.begin(), point.end(), end.point.begin());
   }
   else
   {
      spring.Stop("insertion_" + which + " must have 3 numbers");
   }
   return end;
}

void ReadConnector(const FebInput &entry, FebModel &model)
{
   const std::string type = entry.NeededAttribute("type");
   if (IsJointType(type))
   {
      ReadJoint(entry, model);
      return;
   }
   if (type != "rigid spring")
   {
      entry.StopAll("connectors of the type \"" + type +
                    "\" are not known; there are rigid spring, " +
                    JointTypes());
      return;
   }
   Ligament spring;
   spring.name = "spring " + std::to_string(model.setup.ligaments.size() + 1);
   const std::string name = entry.Attribute("name");
   spring.name = name.empty() ? spring.name : name;
   spring.from = ReadEnd(entry, "a", model);
   spring.to = ReadEnd(entry, "b", model);
   spring.options.stiffness = entry.Number("k", 1.0);
   spring.options.slack_length = entry.Number("free_length", 0.0);
   spring.options.compression = true;
   model.setup.ligaments.push_back(spring);
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
   for (const FebInput &entry : section.All("rigid_connector"))
   {
      ReadConnector(entry, model);
   }
   for (const FebInput &conditions : section.All("rigid_body"))
   {
      ReadFormerBody(conditions, model);
   }
}

} // namespace synovia
