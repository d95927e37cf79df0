#include "synovia/feb/feb_conditions.hpp"

#include <algorithm>

namespace synovia
{

using namespace mfem;

namespace
{
const char *const fixed_components[3] = {"x_dof", "y_dof", "z_dof"};

// Of the word for a component of the displacement; -1 if it is another.
int Component(const std::string &dof)
{
   return dof == "x" ? 0 : dof == "y" ? 1 : dof == "z" ? 2 : -1;
}

// Relative to what there is when a step begins, or not.
void Displace(const std::string &surface, int component, const LoadCurve &value,
              bool relative, const FebInput &where, FebModel &model)
{
   BoundaryCase boundary;
   boundary.surfaces = {surface};
   boundary.relative = relative && model.in_step;
   boundary.displacement[component] = value;
   AddCondition(boundary, where, model);
}

void Press(const std::string &surface, const LoadCurve &value,
           const FebInput &where, FebModel &model)
{
   BoundaryCase boundary;
   boundary.surfaces = {surface};
   boundary.pressure = value;
   AddCondition(boundary, where, model);
}

void VerifyPressure(const FebInput &where, bool relative, const FebModel &model)
{
   if (relative && model.in_step)
   {
      where.Stop("pressures relative to those before are not known");
   }
}

// What dofs say, such as x,y,z or p.
void Prescribe(const FebInput &where, const std::string &surface,
               const std::string &dofs, const LoadCurve &value, FebModel &model)
{
   const bool relative = where.Flag("relative", false);
   std::string word;
   for (const char c : dofs + ",")
   {
      if (c != ',' && c != ' ')
      {
         word += c;
         continue;
      }
      if (word == "p")
      {
         Press(surface, value, where, model);
         VerifyPressure(where, relative, model);
      }
      else if (Component(word) >= 0)
      {
         Displace(surface, Component(word), value, relative, where, model);
      }
      else if (!word.empty())
      {
         where.Stop("the freedom \"" + word +
                    "\" is not known; there are x, y, z and p");
      }
      word.clear();
   }
}

void Fix(const FebInput &condition, const std::string &surface, FebModel &model)
{
   BoundaryCase boundary;
   boundary.surfaces = {surface};
   bool any = false;
   for (int d = 0; d < 3; d++)
   {
      if (condition.Flag(fixed_components[d], false))
      {
         boundary.displacement[d] = LoadCurve(0.0);
         any = true;
      }
   }
   if (any && !surface.empty())
   {
      AddCondition(boundary, condition, model);
   }
}

void Tie(const FebInput &condition, const std::string &surface,
         const std::string &body, FebModel &model)
{
   condition.Ignore("clamp_shells", "there are no deformable shells");
   RigidBodyCase *rigid = model.FindRigid(body, condition);
   if (rigid && !surface.empty())
   {
      rigid->surfaces.push_back(surface);
   }
}

// Takes out of a unit vector what is along others, of length 1 and at right
// angles to each other.
Point3 Rest(Point3 vector, const std::vector<Point3> &others)
{
   for (const Point3 &other : others)
   {
      vector = Sum(vector, -Dot(vector, other), other);
   }
   return vector;
}

void AddDirection(const Point3 &direction, std::vector<Point3> &held)
{
   constexpr real_t independent = 1e-6;
   const Point3 rest = Rest(direction, held);
   if (Length(rest) > independent)
   {
      held.push_back(Sum({{0.0, 0.0, 0.0}}, 1.0 / Length(rest), rest));
   }
}

Point3 Axis(int component)
{
   Point3 axis{{0.0, 0.0, 0.0}};
   axis[component] = 1.0;
   return axis;
}

// The directions in which whole surfaces with the node are held.
std::vector<Point3> HeldAt(int node, const FebInput &section, FebModel &model)
{
   std::vector<Point3> held;
   for (const FebInput &condition : section.All("bc"))
   {
      const std::string set = condition.Attribute("node_set");
      const std::vector<int> *nodes = model.surfaces->FindNodes(set);
      if (condition.Attribute("type") == "zero displacement" && nodes &&
          std::find(nodes->begin(), nodes->end(), node) != nodes->end() &&
          model.surfaces->AreFaces(set))
      {
         for (int d = 0; d < 3; d++)
         {
            if (condition.Flag(fixed_components[d], false))
            {
               AddDirection(Axis(d), held);
            }
         }
      }
   }
   for (const FebGuide &guide : model.guides)
   {
      if (guide.nodes.count(node) > 0)
      {
         AddDirection(guide.normal, held);
      }
   }
   return held;
}

// Whether what holds surfaces holds these nodes, which make up none, as well.
bool IsImplied(const FebInput &condition, const FebInput &section,
               FebModel &model)
{
   constexpr real_t none = 1e-6;
   const std::string set = condition.Attribute("node_set");
   const std::vector<int> *found = model.surfaces->FindNodes(set);
   if (condition.Attribute("type") != "zero displacement" || !found ||
       found->empty() || model.surfaces->AreFaces(set))
   {
      return false;
   }
   const std::vector<int> nodes(*found);
   for (const int node : nodes)
   {
      const std::vector<Point3> held = HeldAt(node, section, model);
      for (int d = 0; d < 3; d++)
      {
         if (condition.Flag(fixed_components[d], false) &&
             Length(Rest(Axis(d), held)) > none)
         {
            return false;
         }
      }
   }
   return true;
}

void ReadCondition(const FebInput &condition, const FebInput &section,
                   FebModel &model)
{
   const std::string type = condition.NeededAttribute("type");
   condition.Attribute("name");
   if (IsImplied(condition, section, model))
   {
      condition.IgnoreAll("conditions of surfaces hold its nodes likewise");
      return;
   }
   const auto has = [&](std::initializer_list<const char *> names)
   { return std::find(names.begin(), names.end(), type) != names.end(); };
   if (!has({"zero displacement", "prescribed displacement",
             "zero fluid pressure", "prescribed fluid pressure", "rigid", "fix",
             "prescribe"}))
   {
      condition.StopAll("conditions of the type \"" + type +
                        "\" are not known; there are zero displacement, "
                        "prescribed displacement, zero fluid pressure, "
                        "prescribed fluid pressure, rigid");
      return;
   }
   const std::string set = condition.NeededAttribute("node_set");
   const std::vector<int> *of_set = model.surfaces->FindNodes(set);
   if (has({"rigid"}) && of_set && model.AreRigid(*of_set))
   {
      condition.IgnoreAll("its nodes are part of a rigid body");
      return;
   }
   const std::string surface = model.surfaces->OfNodes(set, condition);
   const std::string dofs =
      has({"fix"}) ? condition.Word("dofs", "") : condition.Word("dof", "");
   std::optional<LoadCurve> value;
   if (has({"prescribed displacement", "prescribed fluid pressure"}))
   {
      value = model.Value(condition, "value");
   }
   else if (has({"prescribe"}))
   {
      value = model.Value(condition, "scale");
   }
   if (has({"zero displacement"}))
   {
      Fix(condition, surface, model);
   }
   else if (has({"rigid"}))
   {
      Tie(condition, surface, condition.Word("rb", ""), model);
   }
   else if (surface.empty())
   {
      return;
   }
   else if (has({"zero fluid pressure", "prescribed fluid pressure"}))
   {
      const std::vector<int> &nodes = *model.surfaces->FindNodes(set);
      model.pressures.emplace_back(std::set<int>(nodes.begin(), nodes.end()),
                                   value.value_or(LoadCurve(0.0)));
      Press(surface, value.value_or(LoadCurve(0.0)), condition, model);
      VerifyPressure(condition, condition.Flag("relative", false), model);
   }
   else
   {
      Prescribe(condition, surface, dofs, value.value_or(LoadCurve(0.0)),
                model);
   }
}

// <fix>, <prescribe> and <rigid> of version 2.5.
void ReadFormerCondition(const FebInput &condition, FebModel &model)
{
   condition.Attribute("name");
   const std::string surface =
      model.surfaces->OfNodes(condition.NeededAttribute("node_set"), condition);
   if (condition.Name() == "rigid")
   {
      Tie(condition, surface, condition.NeededAttribute("rb"), model);
      return;
   }
   const std::string dofs = condition.NeededAttribute("bc");
   LoadCurve value(0.0);
   if (condition.Name() == "prescribe")
   {
      value = model.Value(condition, "scale");
   }
   if (!surface.empty())
   {
      Prescribe(condition, surface, dofs, value, model);
   }
}
} // namespace

void ReadBoundary(const FebInput &section, FebModel &model)
{
   for (const FebInput &condition : section.All("bc"))
   {
      ReadCondition(condition, section, model);
   }
   ReadRigid(section, model);
   for (const char *name : {"fix", "prescribe", "rigid"})
   {
      for (const FebInput &condition : section.All(name))
      {
         ReadFormerCondition(condition, model);
      }
   }
}

} // namespace synovia
